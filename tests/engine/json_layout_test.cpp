// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/json/json_layout.h"

#include "engine/base/error.h"
#include "engine/json/json_reader.h"
#include "engine/json/json_tree.h"
#include "engine/json/json_writer.h"
#include "tests/support/draw.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace keyline::testing {
namespace {

std::string layout(const std::string& text) { return json_layout(text, "graph.json"); }

std::string compact(const std::string& text) { return JsonWriter().value(parse_json(text, "g")).text(); }

TEST(JsonLayout, PutsBlanksWhereTheyBelong) {
    EXPECT_EQ(
        layout(
            R"({"keyline":1,  "nodes":{"a":{"type":"read","file":"a.exr"},"long":{"in":["a" ,"b"],"o":{},"l":[ ]}}})"),
        R"({
  "keyline": 1,
  "nodes": {
    "a":    { "type": "read", "file": "a.exr" },
    "long": { "in": ["a", "b"], "o": {}, "l": [] }
  }
}
)");
}

TEST(JsonLayout, LeavesEndsOfLinesToTheAuthor) {
    const std::string text = R"({
  "nodes": {
    "a": { "type": "gaussian",
           "in": [{ "x": 1 },
                  { "y": 2 }] },
    "b": {
      "type": "gaussian",
      "sigma": [
        1, 2,
        3
      ]
    }
  }
}
)";
    EXPECT_EQ(layout(text), text);
}

TEST(JsonLayout, BreaksWhatIsTooLong) {
    const std::string words = R"("aaaaaaaaaaaaaaaaaaaa", "bbbbbbbbbbbbbbbbbbbb", "cccccccccccccccccccc")";
    EXPECT_EQ(
        layout(R"({ "nodes": { "n": { "type": "t", "list": [)" + words + ", " + words + R"(], "x": 1 } } })"),
        R"({
  "nodes": {
    "n": { "type": "t",
           "list": ["aaaaaaaaaaaaaaaaaaaa", "bbbbbbbbbbbbbbbbbbbb", "cccccccccccccccccccc", "aaaaaaaaaaaaaaaaaaaa",
                    "bbbbbbbbbbbbbbbbbbbb", "cccccccccccccccccccc"], "x": 1 }
  }
}
)");
}

TEST(JsonLayout, AlignsWhatNoBlankLineParts) {
    EXPECT_EQ(layout(R"({
  "nodes": {
    "a": {"in": 1},
    // of three letters
    "bbb": {"in": 2},


    "cc": {"in": 3},
    "ü": {"in": 4}
  },
  "variables": {"long": 1, "b": 2}
})"),
              R"({
  "nodes": {
    "a":   { "in": 1 },
    // of three letters
    "bbb": { "in": 2 },

    "cc": { "in": 3 },
    "ü":  { "in": 4 }
  },
  "variables": { "long": 1, "b": 2 }
}
)");
}

TEST(JsonLayout, KeepsCommentsWhereTheyStand) {
    EXPECT_EQ(
        layout("// first\n/* and */ {// open\n\"a\" /* key */: // colon\n1 /* one */, // line \n"
               "/* two */ \"b\": [1 /* in */, /* of */ 2 // end\n], \"c\": {/* none */}, \"d\": 3 /* d */\n"
               "\n// close\n} // behind\n\n// last"),
        R"(// first
/* and */
{
  // open
  /* key */ // colon
  "a": 1, /* one */  // line
  /* two */ "b": [
    1, /* in */ /* of */ 2  // end
  ],
  "c": {
    /* none */
  },
  "d": 3 /* d */

  // close
}  // behind

// last
)");
}

TEST(JsonLayout, MakesLineFeedsOfAllEndsOfLines) {
    EXPECT_EQ(layout("\xEF\xBB\xBF{\r\n\"a\": 1, // c\r\"b\": 2\r\n}\r\n"),
              "{\n  \"a\": 1,  // c\n  \"b\": 2\n}\n");
}

TEST(JsonLayout, TellsWhatIsNotJson) {
    try {
        layout("{\n  \"a\": 1\n  \"b\": 2\n}");
        FAIL() << "it was laid out";
    } catch (const Failure& f) {
        EXPECT_EQ(f.error().place.text(), "graph.json:3:3");
    }
}

// JSON with blanks, ends of lines and comments anywhere.
class AnyText {
public:
    explicit AnyText(Draw& draw) : draw_(draw) {}

    std::string document() { return gap() + value(0) + gap(); }

private:
    std::string gap() {
        std::string out;
        for (int i = draw_.whole(0, 3); i > 0; --i) switch (draw_.whole(0, 7)) {
                case 0: out += "\n"; break;
                case 1: out += "\n\n\n"; break;
                case 2: out += fmt::format("// {} \n", ++comments_); break;
                case 3: out += fmt::format("/* {} */", ++comments_); break;
                case 4: out += fmt::format("/* {}\n\n  a */", ++comments_); break;
                default: out += " "; break;
            }
        return out;
    }

    std::string value(int depth) {
        switch (depth < 4 ? draw_.whole(0, 5) : draw_.whole(2, 5)) {
            case 0: return "{" + items(depth, true) + "}";
            case 1: return "[" + items(depth, false) + "]";
            case 2: return draw_.of(std::vector<std::string>{"-1.50e3", "0", "true", "null"});
            case 3: return "\"" + std::string(static_cast<std::size_t>(draw_.whole(0, 70)), 'x') + "\"";
            default: return draw_.of(std::vector<std::string>{R"("\"// no")", R"("/* no */")", R"("ü\\")"});
        }
    }

    std::string items(int depth, bool with_keys) {
        std::string out = gap();
        const int n = draw_.whole(0, 5);
        for (int i = 0; i < n; ++i) {
            if (with_keys)
                out += (depth == 0 && i == 0 ? "\"nodes\"" : fmt::format("\"k{}\"", i)) + gap() + ":" + gap();
            out += value(depth + 1) + gap() + (i + 1 < n ? "," : "") + gap();
        }
        return out;
    }

    Draw& draw_;
    int comments_ = 0;
};

// In the order in which they stand.
std::vector<std::string> comments_of(const std::string& text) {
    std::vector<std::string> out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '"') {
            for (++i; text[i] != '"'; ++i) i += text[i] == '\\' ? 1 : 0;
        } else if (text.compare(i, 2, "//") == 0) {
            const std::size_t end = std::min(text.find('\n', i), text.size());
            out.push_back(text.substr(i, text.find_last_not_of(" \n", end) + 1 - i));
            i = end;
        } else if (text.compare(i, 2, "/*") == 0) {
            const std::size_t end = text.find("*/", i) + 2;
            out.push_back(text.substr(i, end - i));
            i = end - 1;
        }
    }
    return out;
}

TEST(JsonLayout, OfAnyTextIsTheSameAgainAndSaysTheSame) {
    Draw draw(1);
    for (int i = 0; i < 3000; ++i) {
        const std::string text = AnyText(draw).document();
        const std::string once = layout(text);
        ASSERT_EQ(layout(once), once) << text;
        ASSERT_EQ(compact(once), compact(text)) << text;
        ASSERT_EQ(comments_of(once), comments_of(text)) << text << "\n---\n" << once;
        ASSERT_EQ(once.find(" \n"), std::string::npos) << once;
    }
}

// What is read while it is typed.

void expect_inside(const JsonTree& tree, std::size_t begin, std::size_t end) {
    EXPECT_LE(begin, tree.span.begin);
    EXPECT_LE(tree.span.begin, tree.span.end);
    EXPECT_LE(tree.span.end, end);
    for (const JsonItem& item : tree.items) expect_inside(item.value, tree.span.begin, tree.span.end);
}

TEST(JsonTree, OfATextThatIsCutOffLiesInIt) {
    const std::string text = R"({ "keyline": 1, // one
        "nodes": { "a": { "type": "read", "file": "a\".exr" }, "b": { "in": ["a", "a:R"], "x": null } } })";
    for (std::size_t n = 0; n <= text.size(); ++n)
        expect_inside(read_json_tree(text.substr(0, n)).root, 0, n);
    Draw draw(1);
    for (int i = 0; i < 2000; ++i) {
        std::string broken = text;
        for (int k = draw.whole(1, 4); k > 0; --k)
            broken[static_cast<std::size_t>(draw.whole(0, static_cast<int>(text.size()) - 1))] =
                draw.of(std::vector<char>{'{', '}', '[', ']', ',', ':', '"', '\n', '/', '\\', 'x'});
        expect_inside(read_json_tree(broken).root, 0, broken.size());
    }
    expect_inside(read_json_tree(std::string(100000, '[')).root, 0, 100000);
}

std::vector<std::string> keys_in(const std::string& text, const JsonTree& tree) {
    std::vector<std::string> out;
    for (const JsonItem& item : tree.items) out.emplace_back(item.key.of(text));
    return out;
}

TEST(JsonTree, GoesOnBehindWhatIsHalfTyped) {
    const std::vector<std::string> keys{"\"a\"", "\"b\"", "\"c\""};
    for (const char* text : {R"({ "a": , "b": 1, "c": 2 })", R"({ "a": "b": 1, "c": 2 })",
                             "{ \"a\": \"x\n, \"b\": 1 \"c\": 2 }", R"({ "a" "b": 1, "c": 2 })",
                             R"({ "a": [1, "b": 1, "c": 2 })", "{ \"a\": 1,, \"b\": \"x\n, \"c\": }"})
        EXPECT_EQ(keys_in(text, read_json_tree(text).root), keys) << text;
}

}  // namespace
}  // namespace keyline::testing
