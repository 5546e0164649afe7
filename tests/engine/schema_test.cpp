// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/graph/graph.h"
#include "engine/graph/group.h"
#include "engine/graph/group_search.h"
#include "engine/json/json_reader.h"
#include "engine/node/reference.h"
#include "engine/node/registry.h"
#include "tests/support/any_value.h"
#include "tests/support/json_schema.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <optional>
#include <unistd.h>

namespace keyline::testing {
namespace {

namespace fs = std::filesystem;

constexpr unsigned kSeed = 1;
constexpr int kFiles = 2000;
constexpr int kValues = 60;  // of each field

bool loader_takes(const NodeType& type, const Value& object) {
    Diagnostics diagnostics;
    ParamReader reader(diagnostics, type.name, {});
    Value members = object;
    std::erase_if(members.members, [](const Member& m) { return m.key == "type"; });
    validate(type.fields, members, reader);
    return !reader.failed();
}

// What is left of a value at frame 1 when variables, expressions and keys have been replaced; nothing where
// that is a fault.
std::optional<Value> computed(const Value& value, const TypeInfo& type, const Value& variables) {
    Diagnostics diagnostics;
    VariableSources sources;
    sources.declared = &variables;
    Value out = Variables(sources, diagnostics).evaluate(value, type, {1}, diagnostics);
    return diagnostics.ok() ? std::optional(std::move(out)) : std::nullopt;
}

bool loader_takes(const FieldInfo& field, const std::string& value, const std::string& variables) {
    const auto now =
        computed(parse_json(value, "value.json"), field.type, parse_json(variables, "variables.json"));
    Diagnostics diagnostics;
    ParamReader reader(diagnostics, "node", {});
    if (now) validate(field.type, *now, field.name, reader);
    return now && !reader.failed();
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

    // Of what must be there, as a validator that lists all of them counts.
    int faults(const std::string& graph) const { return schema_.missing(parse_json(graph, "g.json")); }

    const Value root_ = parse_json(schema_json(types_of(shipped_groups())), "schema.json");
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
    EXPECT_TRUE(gaussian(R"({"keys": [[1, 1, {"out": [1, 0]}], [4, 3, {"in": ["= -1", "${r}"]}]]})"));
    EXPECT_TRUE(gaussian(R"({"keys": [[1, [1, 2], {"out": [1, [0, 0]], "in": "${t}"}]]})"));
    EXPECT_FALSE(gaussian(R"({"keys": [[1, 1, {"uot": [1, 0]}], [4, 3]]})"));
    EXPECT_FALSE(gaussian(R"({"keys": [[1, 1, {"out": [1]}], [4, 3]]})"));
    EXPECT_FALSE(gaussian(R"({"keys": [[1, 1, {"out": ["1", 0]}], [4, 3]]})"));
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

// Of every field: variables, expressions and keys in all places where they may stand, and in some where not.
TEST_F(Schema, SaysTheSameAsTheLoaderOfWhatIsComputed) {
    Draw draw(kSeed);
    int refused = 0, taken = 0;
    for (const auto& [name, type] : registry().types())
        for (const FieldInfo& f : type.fields)
            for (int i = 0; i < kValues / 2; ++i) {
                AnyValue values(draw, 0);
                values.compute();
                const std::string value = values.of(f.type);
                std::string object;
                AnyValue::add(object, "type", "\"" + type.name + "\"");
                for (const FieldInfo& other : type.fields)
                    if (other.required && other.name != f.name)
                        AnyValue::add(object, other.name, AnyValue(draw, 0).of(other.type));
                AnyValue::add(object, f.name, value);
                const bool loaded = loader_takes(f, value, values.variables());
                ASSERT_EQ(takes(name, "{" + object + "}"), loaded)
                    << "schema and loader, of {" << object << "} with " << values.variables();
                (loaded ? taken : refused) += 1;
            }
    EXPECT_GT(taken, refused);
    EXPECT_GT(refused, 0);
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
        {"what a variable is, a schema does not know", "gaussian",
         R"({"type": "gaussian", "in": "${node}", "sigma": "${text}"})", true, false},
        {"what is between keys is known at a frame", "gaussian",
         R"({"type": "gaussian", "in": "a", "sigma": {"keys": [[1, "a"]]}})", true, false},
    };
    for (const Case& c : cases) {
        EXPECT_EQ(takes(c.type, c.object), c.schema) << c.why;
        EXPECT_EQ(loads(c.type, c.object), c.loader) << c.why;
    }
}

TEST_F(Schema, TellsOneFaultOfANodeWithoutAType) {
    EXPECT_EQ(faults(R"({"keyline": 1, "nodes": {"a": {"color": "#000000"}}})"), 1);
    EXPECT_EQ(faults(R"({"keyline": 1, "nodes": {"a": {}}})"), 1);
    EXPECT_EQ(faults(R"({"keyline": 1, "nodes": {"a": {"type": "constant", "color": "#000000"}}})"), 0);
}

TEST_F(Schema, SaysWhatEveryTypeFieldAndWordMeans) {
    const auto expect_words = [](const Value& any_of) {
        for (const Value& choice : any_of.items)
            if (choice.find("const")) {
                ASSERT_TRUE(choice.find("description")) << choice.shown();
                EXPECT_NE(choice.find("description")->text, "") << choice.shown();
            }
    };
    expect_words(*root_.find("$defs")->find("keyline.node")->find("properties")->find("type")->find("anyOf"));
    for (const auto& [name, type] : registry().types()) {
        const Value& properties = *root_.find("$defs")->find(name)->find("properties");
        for (const FieldInfo& f : type.fields) {
            ASSERT_TRUE(properties.find(f.name)->find("description")) << name << "." << f.name;
            expect_words(*properties.find(f.name)->find("anyOf"));
        }
    }
    for (const Member& m : root_.find("properties")->members)
        EXPECT_TRUE(m.value.find("description")) << m.key;
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

TEST_F(Schema, IsOfAGroupWhereThereAreOutputs) {
    const auto judge = [&](const std::string& more, const std::string& type = "constant") {
        return schema_.takes(parse_json(
            R"({"keyline": 1, "nodes": {"a": {"type": ")" + type + R"("}})" + more + "}", "g.json"));
    };
    const std::string outputs = R"(, "outputs": {"out": "a"})";
    EXPECT_FALSE(judge(R"(, "inputs": {})"));
    EXPECT_FALSE(judge(R"(, "parameters": {})"));
    EXPECT_TRUE(judge(outputs + R"(, "inputs": {"in": {"about": "it", "optional": true}})", "g.json"));
    EXPECT_FALSE(judge(outputs + R"(, "fps": 24)", "g.json"));
    EXPECT_FALSE(judge(R"(, "outputs": {})", "g.json"));
    EXPECT_FALSE(judge(outputs, "write")) << "a group writes nothing";
}

// The parts of a graph file, each right and wrong, put together at random.
struct Part {
    std::string key;
    std::vector<std::string> right, wrong;  // "" leaves it out
};

const std::vector<Part> kParts{
    {"keyline", {"1"}, {"\"1\"", "1.5", "0", "2", "null"}},
    {"about", {"", R"("it")"}, {"1", "{}"}},
    {"$schema", {"", R"("s.json")"}, {"[]"}},
    {"zebra", {"", ""}, {"1"}},
    {"variables",
     {"", "{}", R"({"a": 1, "b-c": [1, {"d": null}]})",
      R"({"a": {"default": 1, "choices": [1, true, "x"], "about": "it"}})", R"({"a": {"default": 1}})",
      R"({"a": "$${b}"})"},
     {"[]", R"({"1a": 1})", R"({"frame": 1})", R"({"a": {"default": 1, "choices": []}})",
      R"({"a": {"choices": [1]}})", R"({"a": {"default": 1, "choices": [[1]]}})",
      R"({"a": {"default": 1, "choices": [1], "abuot": "it"}})",
      R"({"a": {"default": 1, "choices": [1], "about": 2}})"}},
    {"nodes",
     {R"({"a": {"type": "constant", "color": "#000000", "size": [4, 4]}, "out": {"type": "write", "in": "a", "file": "a.exr"}})",
      R"({"a": {"type": "constant", "color": [0, "= 1", 0], "size": [4, 4], "about": "it"},
          "out": {"type": "write", "in": "a", "file": "a.exr", "enabled": "= 1 > 0"}})",
      R"({"a": {"type": "group.json", "gain": 2}, "out": {"type": "write", "in": "a", "file": "a.exr"}})",
      R"({"a": {"type": "constant", "color": "#000000", "size": [4, 4]},
          "b": {"type": "canny", "in": "a", "sigma": "= 1 + 1", "enabled": false},
          "c": {"type": "groups/canny.json", "in": "a", "enabled": "= 1 > 2", "about": "it"},
          "out": {"type": "write", "in": "b", "file": "a.exr"}})"},
     {"[]", R"({"a": {"color": "#000000"}})", R"({"a": {"type": 1}})", R"({"a": {"type": "costant"}})",
      R"({"1a": {"type": "constant", "color": "#000000", "size": [4, 4]}})", R"({"a": 1})",
      R"({"a": {"type": "constant", "color": "#000000", "size": [4, 4], "about": 1}})",
      R"({"a": {"type": "constant", "color": "#000000", "size": [4, 4], "enabled": 1}})",
      R"({"a": {"type": "group.json", "enabled": 1}})", R"({"a": {"type": "group.json", "about": 1}})",
      R"({"a": {"type": "canny", "in": "b", "sgma": 1}})",
      R"({"a": {"type": "canny", "in": "b", "low": "1"}})", R"({"a": {"type": "canny"}})",
      R"({"a": {"type": "cany", "in": "b"}})", R"({"a": {"type": "canny@99", "in": "b"}})",
      R"({"a": {"type": "canny", "in": "b", "enabled": 1}})"}},
};

const std::vector<Part> kGraphParts{
    {"include", {"", R"("vars.json")", R"(["vars.json"])", "[]"}, {"1", R"("")", R"([1])", R"("${")"}},
    {"frames",
     {"", R"("1-9")", R"("5")", R"(" 1 - 9 x 2,20")", R"("9--1")"},
     {"5", R"("a")", R"("1-")", R"("1x2")", R"("1-9x0")"}},
    {"fps", {"", "24", "23.976"}, {"0", "-1", R"("24")"}},
    {"ocio", {"", R"("show.ocio")"}, {"1", R"("")"}},
    {"version", {""}, {"1"}},
    {"inputs", {""}, {"{}"}},
    {"parameters", {""}, {"{}"}},
};

const std::vector<Part> kGroupParts{
    {"version", {"", "1", "12.0"}, {"0", "1.5", R"("1")", "-1", "null"}},
    {"include", {""}, {R"("vars.json")"}},
    {"fps", {""}, {"24"}},
    {"outputs",
     {R"({"out": "a"})", R"({"out": "a:R", "b": "a"})"},
     {"{}", "[]", R"({"out": 1})", R"({"1a": "a"})"}},
    {"inputs",
     {"", "{}", R"({"in": {}, "b": {"about": "it", "optional": false}})"},
     {"[]", R"({"in": 1})", R"({"1a": {}})", R"({"in": {"optional": 1}})", R"({"in": {"about": 1}})",
      R"({"in": {"type": 1}})"}},
    {"parameters",
     {"", R"({"p": {"type": "number", "default": 1.5, "range": [0, 2], "about": "it"}})",
      R"({"p": {"type": "bool"}})", R"({"p": {"type": "word", "words": ["x", "y"], "default": "x"}})",
      R"({"p": {"type": "integer", "default": 2}})",
      R"({"p": {"type": "color", "default": "#12abEF"}, "q": {"type": "pair", "default": 1}})",
      R"({"p": {"type": "file", "default": "a.exr"}, "q": {"type": "text", "default": ""}})"},
     {R"({"p": {}})", R"({"p": {"type": "nomber"}})", R"({"p": {"type": "number", "default": "1"}})",
      R"({"p": {"type": "number", "range": [0]}})", R"({"p": {"type": "number", "range": 1}})",
      R"({"p": {"type": "word"}})", R"({"p": {"type": "word", "words": []}})",
      R"({"p": {"type": "word", "words": [1]}})", R"({"p": {"type": "integer", "default": 0.5}})",
      R"({"p": {"type": "color", "default": "#12"}})", R"({"p": {"type": "pair", "default": [1]}})",
      R"({"p": {"type": "file", "default": ""}})", R"({"p": {"type": "bool", "default": 1}})",
      R"({"p": {"type": "bool", "abuot": "it"}})"}},
};

class SchemaOfFiles : public Schema {
protected:
    SchemaOfFiles() {
        fs::create_directories(folder_);
        write("vars.json", R"({"c": 1})");
        write(
            "group.json",
            R"({"keyline": 1, "parameters": {"gain": {"type": "number", "default": 1}}, "outputs": {"out": "a"},
                  "nodes": {"a": {"type": "constant", "color": "#000000", "size": [4, 4]}}})");
    }
    ~SchemaOfFiles() override { fs::remove_all(folder_); }

    fs::path write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name) << text;
        return folder_ / name;
    }

    bool loads_graph(const std::string& text) const {
        Diagnostics diagnostics;
        Graph::parse(text, (folder_ / "graph.json").string(), folder_, {}, diagnostics);
        return diagnostics.ok();
    }
    // A file of its own each: a system may take long to replace one.
    bool loads_group(const std::string& text) {
        Diagnostics diagnostics;
        read_group(write(fmt::format("{}.json", ++written_), text), {}, diagnostics);
        return diagnostics.ok();
    }

    // One in eight parts is wrong.
    static std::string assembled(Draw& draw, std::vector<Part> parts, const std::vector<Part>& more) {
        parts.insert(parts.end(), more.begin(), more.end());
        std::string members;
        for (const Part& part : parts) {
            const std::string& value = draw.one_in(8) ? draw.of(part.wrong) : draw.of(part.right);
            if (!value.empty()) AnyValue::add(members, part.key, value);
        }
        return "{" + members + "}";
    }

private:
    int written_ = 0;
    const fs::path folder_ = fs::temp_directory_path() / fmt::format("keyline_schema_{}", getpid());
};

TEST_F(SchemaOfFiles, SaysTheSameAsTheLoaderOfWholeGraphs) {
    Draw draw(kSeed);
    int taken = 0;
    for (int i = 0; i < kFiles; ++i) {
        const std::string text = assembled(draw, kParts, kGraphParts);
        const bool loaded = loads_graph(text);
        ASSERT_EQ(schema_.takes(parse_json(text, "graph.json")), loaded) << "schema and loader, of " << text;
        taken += loaded ? 1 : 0;
    }
    EXPECT_GT(taken, kFiles / 10);
    EXPECT_LT(taken, kFiles / 2);
}

// The nodes inside are read where the group is used.
TEST_F(SchemaOfFiles, SaysTheSameAsTheLoaderOfGroups) {
    Draw draw(kSeed);
    std::vector<Part> parts = kParts;
    std::ranges::find(parts, "nodes", &Part::key)->right = {
        R"({"a": {"type": "constant", "color": "#000000", "size": [4, 4]}})"};
    std::ranges::find(parts, "nodes", &Part::key)->wrong = {"[]", "1"};
    std::ranges::find(parts, "keyline", &Part::key)->wrong = {""};
    std::ranges::find(parts, "variables", &Part::key)->wrong = {R"({"a": 1})"};
    int taken = 0;
    for (int i = 0; i < kFiles; ++i) {
        const std::string text = assembled(draw, parts, kGroupParts);
        const bool loaded = loads_group(text);
        ASSERT_EQ(schema_.takes(parse_json(text, "graph.json")), loaded) << "schema and loader, of " << text;
        taken += loaded ? 1 : 0;
    }
    EXPECT_GT(taken, kFiles / 10);
    EXPECT_LT(taken, kFiles / 2);
}

}  // namespace
}  // namespace keyline::testing
