// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/json/json_reader.h"
#include "engine/json/json_writer.h"
#include "engine/json/make_value.h"
#include "engine/node/reference.h"
#include "engine/node/registry.h"
#include "engine/node/schema_values.h"

#include <fmt/format.h>

namespace keyline {

namespace {

// A graph file; what stands in "keyline.node" follows from the registry.  Whether it is a group is told by
// `outputs`, as the loader does.
constexpr const char* kGraph = R"json({
  "$schema": "https://json-schema.org/draft/2020-12/schema",
  "$id": "urn:keyline:graph:1",
  "title": "Keyline graph",
  "description": "A graph of nodes for keyline render, or with outputs a group: a node type for other graphs.",
  "type": "object",
  "required": ["keyline", "nodes"],
  "properties": {
    "$schema": { "description": "Where this schema lies.", "type": "string" },
    "keyline": { "description": "The version of the format: 1.", "const": 1 },
    "version": {
      "description": "Of a group: its version, which a node's type may ask for, as in canny@2.",
      "type": "integer", "minimum": 1, "maximum": 999999999
    },
    "about": { "description": "What the graph is for, in words.", "type": "string" },
    "variables": {
      "description": "Values that have a name: ${name} in any string, name in an expression.",
      "type": "object",
      "propertyNames": { "$ref": "#/$defs/keyline.name", "not": { "const": "frame" } },
      "additionalProperties": { "if": { "type": "object", "required": ["choices"] }, "then": { "$ref": "#/$defs/keyline.choice" } }
    },
    "include": {
      "description": "Files of variables, one name or a list; each stands over what is before it.",
      "anyOf": [
        { "$ref": "#/$defs/keyline.file" },
        { "type": "array", "items": { "$ref": "#/$defs/keyline.file" } }
      ]
    },
    "frames": {
      "description": "The frames of the shot, as 1001-1100: what first and last are in expressions.",
      "type": "string",
      "pattern": "^[ \t]*-?[0-9]+[ \t]*(-[ \t]*-?[0-9]+[ \t]*([x:][ \t]*0*[1-9][0-9]*[ \t]*)?)?(,[ \t]*-?[0-9]+[ \t]*(-[ \t]*-?[0-9]+[ \t]*([x:][ \t]*0*[1-9][0-9]*[ \t]*)?)?)*$"
    },
    "fps": {
      "description": "Frames a second: what fps is in expressions.",
      "type": "number", "exclusiveMinimum": 0
    },
    "ocio": { "description": "The OpenColorIO config, a file's name.", "$ref": "#/$defs/keyline.file" },
    "inputs": {
      "description": "Of a group: what links to it gives, by name; inside, the name is that of a node.",
      "type": "object",
      "propertyNames": { "$ref": "#/$defs/keyline.name" },
      "additionalProperties": { "$ref": "#/$defs/keyline.input" }
    },
    "parameters": {
      "description": "Of a group: what a node of its type takes, by name; inside, each is a variable.",
      "type": "object",
      "propertyNames": { "$ref": "#/$defs/keyline.name" },
      "additionalProperties": { "$ref": "#/$defs/keyline.parameter" }
    },
    "outputs": {
      "description": "What makes the file a group: links to nodes inside, by name; the first is what the group's id alone means.",
      "type": "object", "minProperties": 1,
      "propertyNames": { "$ref": "#/$defs/keyline.name" },
      "additionalProperties": { "type": "string" }
    },
    "nodes": {
      "description": "The nodes by id.",
      "type": "object",
      "propertyNames": { "$ref": "#/$defs/keyline.name" },
      "additionalProperties": { "$ref": "#/$defs/keyline.node" }
    }
  },
  "additionalProperties": false,
  "if": { "required": ["outputs"] },
  "then": {
    "properties": {
      "include": false, "frames": false, "fps": false, "ocio": false,
      "nodes": { "additionalProperties": { "properties": { "type": { "not": { "$ref": "#/$defs/keyline.sink" } } } } }
    }
  },
  "else": { "properties": { "version": false, "inputs": false, "parameters": false } }
})json";

constexpr const char* kDefinitions = R"json({
  "keyline.choice": {
    "description": "A variable with choices.",
    "type": "object",
    "required": ["default", "choices"],
    "properties": {
      "default": { "description": "Its value, one of the choices." },
      "choices": {
        "description": "The values that it may have.",
        "type": "array", "minItems": 1,
        "items": { "type": ["string", "number", "boolean"] }
      },
      "about": { "description": "What it is for, in words.", "type": "string" }
    },
    "additionalProperties": false
  },
  "keyline.input": {
    "type": "object",
    "properties": {
      "about": { "description": "What it is for, in words.", "type": "string" },
      "optional": { "description": "Whether it may be left out.", "type": "boolean" }
    },
    "additionalProperties": false
  },
  "keyline.parameter": {
    "type": "object",
    "required": ["type"],
    "properties": {
      "type": {
        "description": "What it may be.",
        "enum": ["number", "integer", "bool", "text", "file", "word", "pair", "color"]
      },
      "default": { "description": "Its value where none is given; without one it must be given." },
      "range": {
        "description": "[LEAST, MOST]",
        "type": "array", "items": { "type": "number" }, "minItems": 2, "maxItems": 2
      },
      "words": {
        "description": "The words that it may be.",
        "type": "array", "items": { "type": "string" }, "minItems": 1
      },
      "about": { "description": "What it is for, in words.", "type": "string" }
    },
    "additionalProperties": false,
    "allOf": [
      {
        "if": { "properties": { "type": { "const": "word" } }, "required": ["type"] },
        "then": { "required": ["words"] }
      },
      {
        "if": { "properties": { "type": { "enum": ["text", "word", "file"] } } },
        "then": { "properties": { "default": { "type": "string" } } }
      },
      {
        "if": { "properties": { "type": { "const": "file" } } },
        "then": { "properties": { "default": { "minLength": 1 } } }
      },
      {
        "if": { "properties": { "type": { "enum": ["number", "integer"] } } },
        "then": { "properties": { "default": { "type": "number" } } }
      },
      {
        "if": { "properties": { "type": { "const": "integer" } } },
        "then": { "properties": { "default": { "type": "integer" } } }
      },
      {
        "if": { "properties": { "type": { "const": "bool" } } },
        "then": { "properties": { "default": { "type": "boolean" } } }
      },
      {
        "if": { "properties": { "type": { "const": "pair" } } },
        "then": { "properties": { "default": { "anyOf": [
          { "type": "number" },
          { "type": "array", "items": { "type": "number" }, "minItems": 2, "maxItems": 2 }
        ] } } }
      },
      {
        "if": { "properties": { "type": { "const": "color" } } },
        "then": { "properties": { "default": { "anyOf": [
          { "type": "string", "pattern": "^#[0-9A-Fa-f]{6}$" },
          { "type": "array", "items": { "type": "number" }, "minItems": 3, "maxItems": 3 }
        ] } } }
      }
    ]
  }
})json";

constexpr const char* kGroupFile =
    R"json({ "description": "The file of a group.", "pattern": "\\.json$" })json";
constexpr const char* kAbout =
    R"json({ "description": "What the node is for, in words.", "type": "string" })json";
constexpr const char* kOwn = R"json({{ "type": {{ "const": "{}" }}, "about": {} }})json";

// The mistakes that a node may say are none: one, or a list of them.
Value schema_of_meant() {
    std::string words;
    for (const Code code : all_codes())
        if (can_be_meant(code)) words += fmt::format("{}\"{}\"", words.empty() ? "" : ", ", code_name(code));
    return parse_json(fmt::format(R"json({{ "description": "What would be warned of, and is right so.",
                      "anyOf": [ {{ "enum": [{0}] }}, {{ "type": "array", "items": {{ "enum": [{0}] }} }} ] }})json",
                                  words),
                      "meant");
}

FieldInfo enabled_field() {
    return {"enabled",
            "Where it is false, the node passes its leading input on; a node that writes writes nothing.",
            TypeInfo::boolean(), truth_value(true)};
}

class Schema {
public:
    explicit Schema(const std::vector<NodeType>& groups) : groups_(groups) {}

    std::string text() {
        json_.begin_object();
        members(parse_json(kGraph, "graph"));
        json_.key("$defs").begin_object();
        members(parse_json(kDefinitions, "definitions"));
        write_schema_definitions(json_);
        node();
        sink();
        group_file();
        for (const auto& [name, type] : registry().types()) define(type);
        for (const NodeType& group : groups_) define(group);
        return json_.end_object().end_object().text();
    }

private:
    void members(const Value& object) {
        for (const Member& m : object.members) json_.field(m.key, m.value);
    }

    // One definition a type, chosen by `type`: an editor that knows it completes and checks just that.
    void node() {
        json_.key("keyline.node").begin_object().field("type", "object");
        json_.key("required").list(std::vector<std::string>{"type"});
        json_.key("properties").begin_object().key("type").begin_object();
        json_.field("description", "The node's type, or the file of a group.").field("type", "string");
        json_.key("anyOf").begin_array();
        write_schema_of_words(json_, types());
        json_.value(parse_json(kGroupFile, "group"));
        json_.end_array().end_object().end_object();
        json_.key("allOf").begin_array();
        choice("keyline.group", "pattern", "\\.json$");
        for (const std::string& name : registry().names()) choice(name, "const", name);
        for (const NodeType& group : groups_) choice(group.name, "const", group.name);
        json_.end_array().end_object();
    }

    // Where there is no `type`, that is the fault, and not what each of them would want.
    void choice(const std::string& definition, const char* keyword, const std::string& type) {
        json_.begin_object().key("if").begin_object();
        json_.key("required").list(std::vector<std::string>{"type"});
        json_.key("properties").begin_object().key("type").begin_object().field(keyword, type).end_object();
        json_.end_object().end_object();
        json_.key("then").begin_object().field("$ref", "#/$defs/" + definition).end_object().end_object();
    }

    void define(const NodeType& type) {
        json_.key(type.name).begin_object().field("description", type.help);
        write_schema_of_fields(json_, fields_of(type), own_of(type.name));
        json_.end_object();
    }

    // What else it takes, the file says.
    void group_file() {
        json_.key("keyline.group").begin_object();
        json_.field("description", "A node whose type is a graph file.  What it takes, that file says.");
        json_.key("properties").begin_object().key("about").value(parse_json(kAbout, "about"));
        json_.field("meant", schema_of_meant());
        write_schema_of_property(json_, enabled_field());
        json_.end_object().end_object();
    }

    void sink() {
        std::vector<std::string> names;
        for (const auto& [name, type] : registry().types())
            if (type.kind == NodeKind::kSink) names.push_back(name);
        json_.key("keyline.sink").begin_object().key("enum").list(names).end_object();
    }

    std::vector<TypeInfo::WordInfo> types() const {
        std::vector<TypeInfo::WordInfo> out;
        for (const auto& [name, type] : registry().types()) out.push_back({name, type.help});
        for (const NodeType& group : groups_) out.push_back({group.name, group.help});
        return out;
    }

    static std::vector<FieldInfo> fields_of(const NodeType& type) {
        std::vector<FieldInfo> out = type.fields;
        out.push_back(enabled_field());
        return out;
    }

    static Value own_of(const std::string& type) {
        Value out = parse_json(fmt::format(kOwn, type, kAbout), "own");
        out.members.push_back({"meant", {}, schema_of_meant()});
        return out;
    }

    const std::vector<NodeType>& groups_;
    JsonWriter json_{JsonWriter::Style::kIndented};
};

}  // namespace

std::string schema_json(const std::vector<NodeType>& groups) { return Schema(groups).text(); }

}  // namespace keyline
