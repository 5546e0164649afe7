// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/json/json_reader.h"
#include "engine/node/reference.h"
#include "engine/node/registry.h"
#include "tests/support/draw.h"
#include "tests/support/json_schema.h"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace keyline::testing {
namespace {

using Kind = TypeInfo::Kind;

constexpr unsigned kSeed = 1;
constexpr int kValues = 60;  // of each field

// JSON of a type, or nearly: with wrong values in it where `one_in` is not 0, on average one in so many.
class AnyValue {
public:
    AnyValue(Draw& draw, int one_in) : draw_(draw), one_in_(one_in) {}

    std::string of(const TypeInfo& type) {
        if (one_in_ > 0 && draw_.one_in(one_in_)) return wrong(type);
        if (type.optional && draw_.one_in(4)) return "null";
        return right(type);
    }

    std::string object(const std::vector<FieldInfo>& fields) {
        std::string out;
        for (const FieldInfo& f : fields)
            if (one_in_ > 0 ? !draw_.one_in(one_in_) : f.required) add(out, f.name, of(f.type));
        if (one_in_ > 0 && draw_.one_in(2 * one_in_)) add(out, "no_such_key", "1");
        return "{" + out + "}";
    }

    static void add(std::string& members, const std::string& name, const std::string& value) {
        members += fmt::format("{}\"{}\": {}", members.empty() ? "" : ", ", name, value);
    }

private:
    std::string right(const TypeInfo& type) {
        switch (type.kind) {
            case Kind::kNumber: return number(type.range);
            case Kind::kInteger: return fmt::format("{}", std::round(draw_.number(type.range)));
            case Kind::kBool: return draw_.one_in(2) ? "true" : "false";
            case Kind::kString: return draw_.of(std::vector<std::string>{"\"\"", "\"ü\"", "\"R\""});
            case Kind::kFile: return draw_.of(std::vector<std::string>{"\"a.exr\"", "\"b/a.####.exr\""});
            case Kind::kWord: return fmt::format("\"{}\"", draw_.of(type.words).word);
            case Kind::kPair: return draw_.one_in(2) ? number(type.range) : array(2, type.range);
            case Kind::kColor: return draw_.one_in(2) ? "\"#12abEF\"" : array(3, type.range);
            case Kind::kInput: return input(type.takes);
            case Kind::kNumbers: return array(type.items[0], static_cast<int>(type.count));
            case Kind::kList: return array(type.items[0], draw_.whole(0, 3));
            case Kind::kTuple: {
                std::string out;
                for (const TypeInfo& item : type.items) out += (out.empty() ? "" : ", ") + of(item);
                return "[" + out + "]";
            }
            case Kind::kMap: {
                std::string out;
                for (int i = draw_.whole(0, 2); i > 0; --i)
                    add(out, fmt::format("k{}", i), of(type.items[0]));
                return "{" + out + "}";
            }
            case Kind::kObject: return object(type.fields);
            case Kind::kAnyOf: break;
        }
        return of(draw_.of(type.items));
    }

    // Of some other kind, out of the range, too long, or no such word.
    std::string wrong(const TypeInfo& type) {
        const std::vector<std::string> others{
            "null",       "true",       "1",        "0.5",    "-1e9",       "1e9",
            "3000000000", "[]",         "[0]",      "[0, 0]", "[0, 0, 0]",  "[0, 0, 0, 0]",
            "[0.5, 0.5]", "[0, \"a\"]", "[[0, 0]]", "{}",     "{\"a\": 0}", "{\"a\": \"node\"}"};
        const std::vector<std::string> texts{"\"\"", "\"nonsense\"", "\"#12abE\"", "\"#12abEG\""};
        const std::vector<std::string> inputs{"\"\"", "\"node:\"", "\":R\"", "\":\""};
        if (draw_.one_in(2)) return draw_.of(others);
        if (type.kind == Kind::kInput) return draw_.of(inputs);
        if (type.kind == Kind::kFile) return "\"\"";
        const double step = draw_.one_in(2) ? 1 : 0.25;
        if (std::isfinite(type.range.min) && draw_.one_in(2)) return fmt::format("{}", type.range.min - step);
        if (std::isfinite(type.range.max) && draw_.one_in(2)) return fmt::format("{}", type.range.max + step);
        return draw_.of(texts);
    }

    std::string number(const Range& range) { return fmt::format("{}", draw_.number(range)); }
    std::string array(int count, const Range& range) { return array(TypeInfo::number(range), count); }
    std::string array(const TypeInfo& item, int count) {
        std::string out;
        for (int i = 0; i < count; ++i) out += (i == 0 ? "" : ", ") + of(item);
        return "[" + out + "]";
    }

    std::string input(const Takes& takes) {
        if (takes.kind == Takes::Kind::kData || draw_.one_in(2)) return "\"node\"";
        return draw_.of(std::vector<std::string>{"\"_a-1:R\"", "\"node:depth.Z\"", "\"n:a:b\""});
    }

    Draw& draw_;
    int one_in_;
};

bool loader_takes(const NodeType& type, const Value& object) {
    Diagnostics diagnostics;
    ParamReader reader(diagnostics, type.name, {});
    Value members = object;
    std::erase_if(members.members, [](const Member& m) { return m.key == "type"; });
    validate(type.fields, members, reader);
    return !reader.failed();
}

// The node's object with one field that may be wrong; the others are those it needs.
std::string object_with(const NodeType& type, const FieldInfo& field, Draw& draw) {
    std::string members;
    AnyValue::add(members, "type", "\"" + type.name + "\"");
    for (const FieldInfo& f : type.fields)
        if (f.required && f.name != field.name) AnyValue::add(members, f.name, AnyValue(draw, 0).of(f.type));
    AnyValue::add(members, field.name, AnyValue(draw, 3).of(field.type));
    return "{" + members + "}";
}

class Schema : public ::testing::Test {
protected:
    bool takes(const std::string& type, const std::string& object) const {
        return schema_.takes(type, parse_json(object, "node.json"));
    }
    bool loads(const std::string& type, const std::string& object) const {
        return loader_takes(*registry().find(type), parse_json(object, "node.json"));
    }

    const Value root_ = parse_json(schema_json(), "schema.json");
    const JsonSchema schema_{root_};
};

TEST_F(Schema, SaysTheSameAsTheLoaderOfEveryField) {
    Draw draw(kSeed);
    for (const auto& [name, type] : registry().types())
        for (const FieldInfo& f : type.fields) {
            int taken = 0;
            for (int i = 0; i < kValues; ++i) {
                const std::string object = object_with(type, f, draw);
                const bool loaded = loads(name, object);
                ASSERT_EQ(takes(name, object), loaded) << "schema and loader, of " << object;
                taken += loaded ? 1 : 0;
            }
            EXPECT_GT(taken, 0) << name << "." << f.name;
            EXPECT_LT(taken, kValues) << name << "." << f.name;
        }
}

TEST_F(Schema, SaysTheSameAsTheLoaderOfWholeNodes) {
    Draw draw(kSeed);
    for (const auto& [name, type] : registry().types())
        for (int i = 0; i < kValues / 4; ++i) {
            std::string object = AnyValue(draw, 12).object(type.fields);
            object =
                fmt::format("{{\"type\": \"{}\"{}{}", name, object == "{}" ? "" : ", ", object.substr(1));
            ASSERT_EQ(takes(name, object), loads(name, object)) << "schema and loader, of " << object;
        }
}

TEST_F(Schema, TakesAVariableInPlaceOfAnyValue) {
    EXPECT_TRUE(takes("constant", R"({"type": "constant", "color": [1, "${g}", 0], "size": ["${w}", 4]})"));
    EXPECT_TRUE(takes("constant", R"({"type": "constant", "color": "${c}", "size": "${s}"})"));
    EXPECT_TRUE(takes("gaussian", R"({"type": "gaussian", "in": "${a}", "sigma": [1, "${y}"]})"));
    EXPECT_FALSE(takes("constant", R"({"type": "constant", "color": 0, "size": ["w", 4]})"));
}

TEST_F(Schema, TakesExpressionsAndKeysWhereTheLoaderDoes) {
    const auto gaussian = [&](const std::string& sigma) {
        return takes("gaussian", R"({"type": "gaussian", "in": "a", "sigma": )" + sigma + "}");
    };
    EXPECT_TRUE(gaussian(R"("= 1 + 1")"));
    EXPECT_TRUE(gaussian(R"(["= 1", 2])"));
    EXPECT_TRUE(gaussian(R"({"keys": [[1, 1], [2, 3, "smooth"]], "before": "loop", "on": 2})"));
    EXPECT_FALSE(gaussian(R"("1 + 1")"));
    EXPECT_FALSE(gaussian(R"({"keys": []})"));
    EXPECT_FALSE(gaussian(R"({"keys": [[1]]})"));
    EXPECT_FALSE(gaussian(R"({"keys": [[1, 1]], "on": 0.5})"));
    EXPECT_FALSE(gaussian(R"({"keys": [[1, 1]], "befor": "hold"})"));
    EXPECT_TRUE(
        takes("dilate", R"({"type": "dilate", "in": "a", "shape": "= 'disk'", "enabled": "= k > 1"})"));
    EXPECT_FALSE(takes("dilate", R"({"type": "dilate", "in": {"keys": [[1, "a"]]}, "enabled": true})"));
    EXPECT_FALSE(takes("dilate", R"({"type": "dilate", "in": "a", "enabled": 1})"));
    EXPECT_TRUE(takes("read", R"({"type": "read", "file": {"keys": [[1, "a.exr"], [5, "b.exr"]]}})"));
}

// What a schema can't say, or says although another pass does.
TEST_F(Schema, DiffersFromTheLoader) {
    struct Case {
        const char* why;
        std::string type, object;
        bool schema, loader;
    };
    const std::vector<Case> cases{
        {"the grammar of a file's name is the program's", "read", R"({"type": "read", "file": "~/a.exr"})",
         true, false},
        {"what no id can be is told when links are checked, as an unknown node", "gaussian",
         R"({"type": "gaussian", "in": "9 a", "sigma": 1})", false, true},
        {"a schema sees words before variables are replaced in them", "gaussian",
         R"({"type": "gaussian", "in": "${shot}_a", "sigma": 1})", false, true},
    };
    for (const Case& c : cases) {
        EXPECT_EQ(takes(c.type, c.object), c.schema) << c.why;
        EXPECT_EQ(loads(c.type, c.object), c.loader) << c.why;
    }
}

TEST_F(Schema, IsOfAWholeGraph) {
    const auto judge = [&](const std::string& json) { return schema_.takes(parse_json(json, "g.json")); };
    EXPECT_TRUE(judge(R"({"keyline": 1, "nodes": {"a": {"type": "constant", "color": "#000000"}}})"));
    EXPECT_FALSE(judge(R"({"keyline": 1, "nodes": {"a": {"type": "constant", "colour": "#000000"}}})"));
    EXPECT_FALSE(judge(R"({"keyline": 1, "nodes": {"1": {"type": "constant", "color": "#000000"}}})"));
    EXPECT_FALSE(judge(R"({"nodes": {}})"));
    EXPECT_TRUE(judge(R"({"keyline": 1, "nodes": {}, "frames": "1-9", "fps": 24, "include": ["a.json"]})"));
    EXPECT_FALSE(judge(R"({"keyline": 1, "nodes": {}, "fps": 0})"));
    EXPECT_FALSE(judge(R"({"keyline": 1, "nodes": {}, "include": 1})"));
}

}  // namespace
}  // namespace keyline::testing
