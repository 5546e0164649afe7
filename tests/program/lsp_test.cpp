// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/program/program.h"

#include <algorithm>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

// `keyline lsp` as an editor sees it.

namespace keyline::test {

namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::IsSupersetOf;
using testing::Not;
using Json = nlohmann::json;

std::string framed(const Json& message) {
    const std::string text = message.dump();
    return fmt::format("Content-Length: {}\r\n\r\n{}", text.size(), text);
}

std::vector<Json> messages_in(const std::string& all) {
    std::vector<Json> out;
    for (std::size_t at = 0; at < all.size();) {
        const std::size_t begin = all.find("\r\n\r\n", at) + 4;
        const std::size_t length = std::stoul(all.substr(at + std::string("Content-Length: ").size()));
        out.push_back(Json::parse(all.substr(begin, length)));
        at = begin + length;
    }
    return out;
}

Json position(int line, int character) { return {{"line", line}, {"character", character}}; }

// A text with a cursor: where the bar stands.
struct Typed {
    std::string text;
    Json at;
};

Typed typed(std::string text) {
    const std::size_t bar = text.find('|');
    text.erase(bar, 1);
    const auto line = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(bar), '\n');
    const std::size_t begin = bar == 0 ? 0 : text.rfind('\n', bar - 1) + 1;
    return {text, position(static_cast<int>(line), static_cast<int>(bar - begin))};
}

class Lsp : public ProgramTest {
protected:
    Lsp() {
        fs::create_symlink(plates(), folder() / "plates");
        fs::create_symlink(plates().parent_path() / "groups", folder() / "groups");
    }

    std::string uri() const { return "file://" + (folder() / "g.json").string(); }

    // What comes back for these messages, and what was told at the end.
    std::vector<Json> talk(const std::vector<Json>& messages) const {
        std::string all =
            framed({{"jsonrpc", "2.0"}, {"id", 0}, {"method", "initialize"}, {"params", Json::object()}});
        for (const Json& m : messages) all += framed(m);
        const Outcome run = keyline({"lsp"}, {.in = write("messages", all)});
        EXPECT_THAT(run.err, IsEmpty());
        return messages_in(run.out);
    }

    Json opened(const std::string& text) const {
        return {
            {"jsonrpc", "2.0"},
            {"method", "textDocument/didOpen"},
            {"params",
             {{"textDocument", {{"uri", uri()}, {"languageId", "json"}, {"version", 1}, {"text", text}}}}}};
    }

    // The result of one question about a text.
    Json ask(const std::string& text, const std::string& method, Json params = Json::object()) const {
        params["textDocument"] = {{"uri", uri()}};
        for (const Json& m :
             talk({opened(text), {{"jsonrpc", "2.0"}, {"id", 1}, {"method", method}, {"params", params}}}))
            if (m.contains("id") && m.at("id") == 1)
                return m.contains("result") ? m.at("result") : m.at("error");
        ADD_FAILURE() << "no answer to " << method;
        return {};
    }
    Json ask_at(const std::string& text, const std::string& method) const {
        const Typed t = typed(text);
        return ask(t.text, method, {{"position", t.at}});
    }

    std::vector<std::string> offered(const std::string& text) const {
        std::vector<std::string> out;
        const Json answer = ask_at(text, "textDocument/completion");
        for (const Json& item : answer.at("items")) out.push_back(item.at("label"));
        return out;
    }

    // What is said of a text: "LINE:CHARACTER MESSAGE" each.
    std::vector<std::string> told(const std::vector<Json>& messages) const {
        std::vector<std::string> out;
        for (const Json& m : talk(messages)) {
            if (m.value("method", "") != "textDocument/publishDiagnostics") continue;
            out.clear();
            for (const Json& d : m.at("params").at("diagnostics")) {
                const Json& start = d.at("range").at("start");
                out.push_back(fmt::format("{}:{} {}", start.at("line").get<int>(),
                                          start.at("character").get<int>(),
                                          d.at("message").get<std::string>()));
            }
        }
        return out;
    }

    std::string hovered(const std::string& text) const {
        const Json hover = ask_at(text, "textDocument/hover");
        return hover.is_null() ? "" : hover.at("contents").at("value").get<std::string>();
    }
};

// Nodes in a graph that is whole but for them.
std::string graph_of(const std::string& nodes) {
    return R"({
  "keyline": 1,
  "variables": { "soft": 2, "plate": "plates/street.####.exr" },
  "nodes": {
    "render": { "type": "read", "file": "${plate}" },
    )" + nodes +
           R"(,
    "out": { "type": "write", "in": "render", "file": "out.####.exr" }
  }
})";
}

TEST_F(Lsp, TellsWhatCheckTells) {
    EXPECT_THAT(told({opened(graph_of(R"("a": { "type": "gaussian", "in": "render:Combind", "sgma": 2 })"))}),
                ElementsAre("5:55 unknown key 'sgma'; did you mean 'sigma'?",
                            HasSubstr("5:4 nothing that is written uses it")));
}

TEST_F(Lsp, TellsNothingOfASoundGraph) {
    EXPECT_THAT(
        told({opened(graph_of(R"("a": { "type": "gaussian", "in": "render:Combined", "sigma": "${soft}" },
    "b": { "type": "write", "in": "a", "file": "b.####.exr" })"))}),
        IsEmpty());
}

TEST_F(Lsp, TellsOfAHalfTypedTextWhatIsWrongWithItAndWithTheOtherNodes) {
    EXPECT_THAT(
        told({opened(graph_of(R"("a": { "type": "gaussian", "in":  },
    "b": { "type": "gausian", "in": "render" })"))}),
        ElementsAre(HasSubstr("5:38 expected a value"), HasSubstr("6:19 there is no node type 'gausian'")));
}

TEST_F(Lsp, FollowsChanges) {
    const std::string text = graph_of(R"("a": { "type": "gausian", "in": "render" })");
    const Json change = {
        {"jsonrpc", "2.0"},
        {"method", "textDocument/didChange"},
        {"params",
         {{"textDocument", {{"uri", uri()}, {"version", 2}}},
          {"contentChanges",
           {{{"range", {{"start", position(5, 23)}, {"end", position(5, 23)}}}, {"text", "s"}}}}}}};
    EXPECT_THAT(told({opened(text)}), Contains(HasSubstr("there is no node type")));
    EXPECT_THAT(told({opened(text), change}), Not(Contains(HasSubstr("there is no node type"))));
}

TEST_F(Lsp, OffersKeysTypesAndWords) {
    EXPECT_THAT(offered(R"({ "keyline": 1, | })"),
                AllOf(Contains("nodes"), Contains("outputs"), Not(Contains("keyline"))));
    EXPECT_THAT(offered(graph_of(R"("a": { "type": "dilate", | })")),
                AllOf(IsSupersetOf({"in", "radius", "shape", "enabled"}), Not(Contains("type"))));
    EXPECT_THAT(offered(graph_of(R"("a": { "type": "dil|" })")), IsSupersetOf({"dilate", "read", "groups/"}));
    EXPECT_THAT(offered(graph_of(R"("a": { "type": "groups/|" })")), Contains("groups/canny.json"));
    EXPECT_THAT(offered(graph_of(R"("a": { "type": "groups/canny.json", "| })")),
                IsSupersetOf({"in", "sigma"}));
    EXPECT_THAT(offered(graph_of(R"("a": { "type": "dilate", "shape": | })")),
                IsSupersetOf({"disk", "square"}));
    EXPECT_THAT(offered(graph_of(R"("a": { "type": "weight", "by_depth": { | } })")), Contains("power"));
    EXPECT_THAT(offered(graph_of(R"("a": { "type": "gaussian", "sigma": { "keys": [[1, 2]], | } })")),
                IsSupersetOf({"before", "after", "on"}));
}

TEST_F(Lsp, PutsAnOfferInPlaceOfWhatIsTyped) {
    const Json items =
        ask_at(graph_of(R"("a": { "type": "dilate", "ra|": 2 })"), "textDocument/completion").at("items");
    const auto radius = std::ranges::find_if(items, [](const Json& i) { return i.at("label") == "radius"; });
    ASSERT_NE(radius, items.end());
    EXPECT_EQ(radius->at("textEdit").at("newText"), "\"radius\"");
    EXPECT_EQ(radius->at("textEdit").at("range"),
              Json({{"start", position(5, 29)}, {"end", position(5, 33)}}));
    EXPECT_THAT(radius->at("documentation").get<std::string>(), Not(IsEmpty()));
}

TEST_F(Lsp, OffersNodesAndTheLayersOfTheFilesThatTheyRead) {
    EXPECT_THAT(offered(graph_of(R"("a": { "type": "gaussian", "in": "|" })")),
                AllOf(IsSupersetOf({"render", "out"}), Not(Contains("a"))));
    EXPECT_THAT(offered(graph_of(R"("a": { "type": "over", "fg": "render:|)")),
                IsSupersetOf({"render:ViewLayer.Combined", "render:ViewLayer.Depth.Z"}));
    EXPECT_THAT(offered(graph_of(R"("a": { "type": "gradient", "in": "render:ViewLayer.Depth.Z" },
    "b": { "type": "threshold", "in": "a:|" })")),
                Contains("a:magnitude"));
    EXPECT_THAT(offered(graph_of(R"("a": { "type": "contours", "in": "render" },
    "b": { "type": "smooth", "in": "a:|" })")),
                AllOf(IsSupersetOf({"a:outline", "a:crease"}), Not(Contains("a:magnitude"))));
}

TEST_F(Lsp, OffersFirstTheLayersThatAnInputTakes) {
    const auto first = [&](const std::string& text) {
        std::vector<std::string> out;
        const Json answer = ask_at(graph_of(text), "textDocument/completion");
        for (const Json& item : answer.at("items"))
            if (!item.contains("sortText")) out.push_back(item.at("label"));
        return out;
    };
    EXPECT_THAT(first(R"("a": { "type": "ycolor", "in": "render:|" })"),
                testing::UnorderedElementsAre("render:ViewLayer.Combined", "render:ViewLayer.DiffCol"));
    EXPECT_THAT(first(R"("a": { "type": "planestep", "in": "render:|" })"),
                AllOf(IsSupersetOf({"render:ViewLayer.Depth", "render:ViewLayer.Depth.Z"}),
                      Not(Contains("render:ViewLayer.Normal"))));
    EXPECT_THAT(first(R"("a": { "type": "cel", "normal": "render:|" })"),
                testing::UnorderedElementsAre("render:ViewLayer.Normal", "render:ViewLayer.Vector"));
}

TEST_F(Lsp, OffersWhatFilesAndConfigsHold) {
    EXPECT_THAT(offered(graph_of(R"("a": { "type": "cryptomatte", "in": "render", "objects": ["|"] })")),
                Contains("wall"));
    EXPECT_THAT(offered(graph_of(R"("a": { "type": "cryptomatte", "in": "render", "layer": "|" })")),
                Contains(HasSubstr("CryptoObject")));
    EXPECT_THAT(offered(graph_of(R"("a": { "type": "colorspace", "in": "render", "to": "|" })")),
                Contains(HasSubstr("sRGB")));
    EXPECT_THAT(offered(graph_of(R"("a": { "type": "display", "in": "render", "view": "|" })")),
                Contains("Un-tone-mapped"));
    EXPECT_THAT(offered(graph_of(R"("a": { "type": "read", "file": "plates/|" })")),
                Contains("plates/street.####.exr"));
}

TEST_F(Lsp, OffersVariablesInTextsAndExpressions) {
    EXPECT_THAT(offered(graph_of(R"("a": { "type": "gaussian", "in": "render", "sigma": "${|" })")),
                ElementsAre("soft", "plate"));
    EXPECT_THAT(offered(graph_of(R"("a": { "type": "gaussian", "in": "render", "sigma": "= 2 * so|" })")),
                IsSupersetOf({"soft", "height", "smoothstep"}));
}

TEST_F(Lsp, SaysWhatStandsThere) {
    EXPECT_THAT(
        hovered(graph_of(R"("a": { "type": "gaussian", "in": "render:Combined", "sig|ma": "= 2 * soft" })")),
        AllOf(HasSubstr("Standard deviation"), HasSubstr("from 0 to 500 pixels; default 1"),
              HasSubstr("At frame 1: `4`")));
    EXPECT_THAT(hovered(graph_of(R"("a": { "type": "gaus|sian", "in": "render:Combined" })")),
                HasSubstr("Blurs every channel"));
    EXPECT_THAT(hovered(graph_of(R"("a": { "type": "dilate", "in": "render:Combined", "shape": "di|sk" })")),
                HasSubstr("\"disk\": "));
    EXPECT_THAT(
        hovered(graph_of(R"("a": { "type": "dilate", "in": "ren|der:Combined", "radius": "${soft}" },
    "b": { "type": "write", "in": "a", "file": "b.####.exr" })")),
        AllOf(HasSubstr("**render**: read."), HasSubstr("480 × 270"), HasSubstr("ViewLayer.Depth.Z")));
    EXPECT_THAT(hovered(graph_of(R"("a": { "type": "dilate", "in": "render", "radius": "${so|ft}" })")),
                "**soft**: `2`");
    EXPECT_THAT(hovered("{ \"key|line\": 1 }"), HasSubstr("The version of the format"));
}

TEST_F(Lsp, GoesToDefinitionsAndFindsUses) {
    const std::string text =
        graph_of(R"("a": { "type": "gaussian", "in": "ren|der:Combined", "sigma": "= soft * 2" })");
    const Json there = ask_at(text, "textDocument/definition");
    ASSERT_EQ(there.size(), 1U);
    EXPECT_EQ(there[0].at("uri"), uri());
    EXPECT_EQ(there[0].at("range").at("start"), position(4, 5));
    EXPECT_EQ(ask_at(text, "textDocument/references").size(), 3U);
    const Json group =
        ask_at(graph_of(R"("a": { "type": "groups/ca|nny.json" })"), "textDocument/definition");
    ASSERT_EQ(group.size(), 1U);
    EXPECT_THAT(group[0].at("uri").get<std::string>(), HasSubstr("/groups/canny.json"));
}

TEST_F(Lsp, Renames) {
    const Typed t =
        typed(graph_of(R"("a": { "type": "gaussian", "in": "render:Combined", "sigma": "= so|ft * 2" },
    "b": { "type": "gaussian", "in": "a", "sigma": "${soft}" })"));
    const Json edits =
        ask(t.text, "textDocument/rename", {{"position", t.at}, {"newName", "blur"}}).at("changes").at(uri());
    EXPECT_EQ(edits.size(), 3U);
    for (const Json& edit : edits) EXPECT_EQ(edit.at("newText"), "blur");
    EXPECT_THAT(ask(t.text, "textDocument/rename", {{"position", t.at}, {"newName", "plate"}}).at("message"),
                "there is another 'plate'");
    EXPECT_THAT(ask(t.text, "textDocument/rename", {{"position", t.at}, {"newName", "1"}})
                    .at("message")
                    .get<std::string>(),
                HasSubstr("is no name"));
}

TEST_F(Lsp, OutlinesFormatsAndShowsColours) {
    const std::string text = graph_of(R"("a": {"type": "constant", "color": "#ff0000", "like": "render"},
    "b": { "type": "ink", "in": "a", "color": [1, 1, 1] })");
    const Json outline = ask(text, "textDocument/documentSymbol");
    ASSERT_EQ(outline.size(), 6U);
    EXPECT_EQ(outline[2].at("name"), "render");
    EXPECT_EQ(outline[2].at("detail"), "read");
    const Json format = ask(text, "textDocument/formatting");
    ASSERT_EQ(format.size(), 1U);
    EXPECT_THAT(format[0].at("newText").get<std::string>(),
                HasSubstr("\n    \"a\":      { \"type\": \"constant\""));
    const Json colors = ask(text, "textDocument/documentColor");
    ASSERT_EQ(colors.size(), 2U);
    EXPECT_EQ(colors[0].at("color").at("red"), 1);
    EXPECT_EQ(colors[0].at("color").at("green"), 0);
    const Json written = ask(text, "textDocument/colorPresentation",
                             {{"color", {{"red", 1}, {"green", 0.5}, {"blue", 0}, {"alpha", 1}}},
                              {"range", colors[1].at("range")}});
    EXPECT_EQ(written[0].at("label"), "[1, 0.214, 0]");
    EXPECT_EQ(written[1].at("label"), "\"#ff8000\"");
}

TEST_F(Lsp, DoesWhatErrorsSuggest) {
    const std::string text = graph_of(R"("a": { "type": "gaussian", "sgma": 2 },
    "b": { "type": "gausian", "in": "render" })");
    const auto actions = [&](int line, int character) {
        const Json range = {{"start", position(line, character)}, {"end", position(line, character)}};
        return ask(text, "textDocument/codeAction",
                   {{"range", range}, {"context", {{"diagnostics", Json::array()}}}});
    };
    const Json key = actions(5, 33);
    ASSERT_EQ(key.size(), 1U);
    EXPECT_EQ(key[0].at("title"), "Write 'sigma'");
    const Json edit = key[0].at("edit").at("changes").at(uri())[0];
    EXPECT_EQ(edit.at("newText"), "sigma");
    EXPECT_EQ(edit.at("range"), Json({{"start", position(5, 32)}, {"end", position(5, 36)}}));
    const Json missing = actions(5, 5);
    ASSERT_EQ(missing.size(), 1U);
    EXPECT_EQ(missing[0].at("title"), "Add 'in'");
    EXPECT_EQ(actions(6, 20)[0].at("title"), "Write 'gaussian'");
}

TEST_F(Lsp, TellsOfGroupsWhatTheyDeclareWrong) {
    EXPECT_THAT(told({opened(
                    R"({ "keyline": 1, "outputs": { "out": "a" }, "parameters": { "p": { "type": "nomber" } },
  "nodes": { "a": { "type": "constant" } } })")}),
                ElementsAre(HasSubstr("did you mean 'number'?")));
}

TEST_F(Lsp, CountsInUnitsOfUtf16) {
    EXPECT_THAT(told({opened("{ \"keyline\": 1, \"about\": \"ü𝄞\", \"nodez\": {} }")}),
                Contains(HasSubstr("0:32 unknown key 'nodez'")));
}

TEST_F(Lsp, GoesOnWhateverItIsAsked) {
    const std::vector<Json> answers =
        talk({{{"jsonrpc", "2.0"}, {"id", 1}, {"method", "no/such"}},
              {{"jsonrpc", "2.0"}, {"id", "x"}, {"method", "textDocument/hover"}},
              {{"jsonrpc", "2.0"}, {"method", "$/setTrace"}},
              {{"jsonrpc", "2.0"}, {"id", 2}, {"method", "shutdown"}}});
    ASSERT_EQ(answers.size(), 4U);
    EXPECT_TRUE(answers[0].at("result").contains("capabilities"));
    EXPECT_EQ(answers[1].at("error").at("code"), -32601);
    EXPECT_EQ(answers[2].at("id"), "x");
    EXPECT_TRUE(answers[2].at("result").is_null());
    EXPECT_TRUE(answers[3].at("result").is_null());
}

TEST_F(Lsp, AnswersAtEveryPlaceOfATextThatIsCutOff) {
    const std::string text = graph_of(R"("a": { "type": "cryptomatte", "in": "render", "objects": ["w*"] })");
    std::vector<Json> messages;
    int questions = 0;
    for (std::size_t n = 0; n < text.size(); n += 7) {
        const Typed t = typed(text.substr(0, n) + "|");
        messages.push_back(opened(t.text));
        for (const char* method :
             {"completion", "hover", "definition", "references", "documentSymbol", "documentColor"})
            messages.push_back({{"jsonrpc", "2.0"},
                                {"id", ++questions},
                                {"method", std::string("textDocument/") + method},
                                {"params", {{"textDocument", {{"uri", uri()}}}, {"position", t.at}}}});
    }
    int answers = 0;
    for (const Json& m : talk(messages)) answers += m.contains("result") && m.at("id") != 0 ? 1 : 0;
    EXPECT_EQ(answers, questions);
}

TEST_F(Lsp, LeavesWithAStatusThatSaysWhetherItWasToldTo) {
    const Json shutdown = {{"jsonrpc", "2.0"}, {"id", 1}, {"method", "shutdown"}};
    const Json exit = {{"jsonrpc", "2.0"}, {"method", "exit"}};
    EXPECT_EQ(keyline({"lsp", "--stdio"}, {.in = write("in", framed(shutdown) + framed(exit))}).status, 0);
    EXPECT_EQ(keyline({"lsp"}, {.in = write("in", framed(exit))}).status, 1);
    const Outcome typed_by_hand = keyline({"lsp"}, {.in = write("in", "hello\r\n\r\n")});
    EXPECT_EQ(typed_by_hand.status, 3);
    EXPECT_THAT(typed_by_hand.err, HasSubstr("no message of the language server protocol"));
}

}  // namespace

}  // namespace keyline::test
