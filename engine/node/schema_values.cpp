// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/node/schema_values.h"

#include "engine/base/identifier.h"
#include "engine/json/json_reader.h"
#include "engine/node/parts.h"
#include "engine/params/computed.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>

namespace keyline {

namespace {

// What stands in "${…}": a variable, the frame, or the environment's, which is always text.
std::string reference(bool may_be_text) {
    return fmt::format(R"(\$\{{({}{})\}})", kIdentifierPattern, may_be_text ? "|env:[^}]+" : "");
}

// "$${" is no reference.
std::string holds_reference() { return "(^|[^$])" + reference(true); }

// "${" without a name and a "}".
std::string broken_reference() {
    return fmt::format(R"((^|[^$])\$\{{(?!({}|env:[^}}]+)\}}))", kIdentifierPattern);
}

// A value that moves.  Its values may be computed and are judged where they are used.
constexpr const char* kKeys = R"json({
  "type": "object",
  "required": ["keys"],
  "properties": {
    "keys": {
      "description": "[FRAME, VALUE], or [FRAME, VALUE, HOW IT GOES ON], in the order of the frames.",
      "anyOf": [
        { "type": "array", "minItems": 1, "items": { "$ref": "#/$defs/keyline.key" } },
        { "$ref": "#/$defs/keyline.variable" }
      ]
    },
    "before": { "description": "Before the first key.", "$ref": "#/$defs/keyline.beyond" },
    "after": { "description": "After the last key.", "$ref": "#/$defs/keyline.beyond" },
    "on": {
      "description": "2 is on twos: each value is held for so many frames.",
      "anyOf": [
        { "type": "integer", "minimum": 1 },
        { "$ref": "#/$defs/keyline.variable" },
        { "$ref": "#/$defs/keyline.expression" }
      ]
    }
  },
  "additionalProperties": false
})json";

constexpr const char* kKey = R"json({
  "type": "array", "minItems": 2, "maxItems": 3,
  "prefixItems": [
    { "anyOf": [{ "type": "number" }, { "$ref": "#/$defs/keyline.variable" }, { "$ref": "#/$defs/keyline.expression" }] },
    true,
    { "anyOf": [
      { "const": "linear", "description": "At the same pace." },
      { "const": "smooth", "description": "It starts and arrives gently." },
      { "const": "hold", "description": "It stays until the next key." },
      { "$ref": "#/$defs/keyline.tangents" },
      { "$ref": "#/$defs/keyline.template" },
      { "$ref": "#/$defs/keyline.expression" }
    ] }
  ]
})json";

constexpr const char* kTangents = R"json({
  "description": "The inner points of a cubic Bézier curve, seen from the key.",
  "type": "object",
  "properties": {
    "in": { "description": "[FRAMES, RISE] of the point that the curve arrives from; FRAMES is below 0.", "$ref": "#/$defs/keyline.tangent" },
    "out": { "description": "[FRAMES, RISE] of the point that the curve leaves for.", "$ref": "#/$defs/keyline.tangent" }
  },
  "additionalProperties": false
})json";

constexpr const char* kTangent = R"json({
  "anyOf": [
    {
      "type": "array", "minItems": 2, "maxItems": 2,
      "prefixItems": [
        { "anyOf": [{ "type": "number" }, { "$ref": "#/$defs/keyline.variable" }, { "$ref": "#/$defs/keyline.expression" }] },
        true
      ]
    },
    { "$ref": "#/$defs/keyline.variable" },
    { "$ref": "#/$defs/keyline.expression" }
  ]
})json";

constexpr const char* kBeyond = R"json({
  "anyOf": [
    { "const": "hold", "description": "The nearest key's value." },
    { "const": "loop", "description": "The keys again." },
    { "const": "extend", "description": "On in the direction of the last two." },
    { "$ref": "#/$defs/keyline.template" },
    { "$ref": "#/$defs/keyline.expression" }
  ]
})json";

class ValueSchema {
public:
    explicit ValueSchema(JsonWriter& json) : json_(json) {}

    void object(const std::vector<FieldInfo>& fields, const Value& own) {
        json_.field("type", "object");
        required(fields);
        json_.key("properties").begin_object();
        for (const Member& m : own.members) json_.field(m.key, m.value);
        for (const FieldInfo& f : fields) field(f);
        json_.end_object().field("additionalProperties", false);
    }

    void words(const std::vector<TypeInfo::WordInfo>& words) {
        for (const TypeInfo::WordInfo& w : words)
            json_.begin_object().field("const", w.word).field("description", w.help).end_object();
    }

    void text(const std::string& pattern) {
        json_.begin_object().field("type", "string").field("pattern", pattern).end_object();
    }

    void field(const FieldInfo& f) {
        json_.key(f.name).begin_object().field("description", description(f));
        if (!f.required && !f.default_value.is(Value::Kind::kNull)) json_.field("default", f.default_value);
        any_of(f.type);
        json_.end_object();
    }

private:
    void required(const std::vector<FieldInfo>& fields) {
        std::vector<std::string> names;
        for (const FieldInfo& f : fields)
            if (f.required) names.push_back(f.name);
        if (!names.empty()) json_.key("required").list(names);
    }

    static std::string description(const FieldInfo& f) {
        const std::string range = f.type.range_text();
        const bool is_sentence = f.help.ends_with('.') || f.help.empty();
        return range.empty() ? f.help : fmt::format("{}{} It is {}.", f.help, is_sentence ? "" : ".", range);
    }

    // All that may stand for a value of the type: what validate() passes, and what comes to it.
    void any_of(const TypeInfo& type) {
        json_.key("anyOf").begin_array();
        choices(type);
        refer_to(is_text(type) ? "template" : "variable");
        if (takes_expressions(type)) refer_to("expression");
        if (takes_keys(type)) refer_to("keys");
        json_.end_array();
    }

    // Whether text with variables in it may come to one.
    static bool is_text(const TypeInfo& type) {
        using Kind = TypeInfo::Kind;
        const bool is_itself = type.kind == Kind::kString || type.kind == Kind::kFile ||
                               type.kind == Kind::kWord || type.kind == Kind::kColor ||
                               type.kind == Kind::kInput;
        return is_itself || (type.kind == Kind::kAnyOf && std::ranges::any_of(type.items, is_text));
    }

    void refer_to(const char* definition) {
        json_.begin_object().field("$ref", fmt::format("#/$defs/keyline.{}", definition)).end_object();
    }

    void any_of_object(const TypeInfo& type) {
        json_.begin_object();
        any_of(type);
        json_.end_object();
    }

    // The items of an "anyOf".
    void choices(const TypeInfo& type) {
        if (type.optional) plain("null");
        switch (type.kind) {
            case TypeInfo::Kind::kAnyOf:
                for (const TypeInfo& item : type.items) choices(item);
                return;
            case TypeInfo::Kind::kPair: number(type.range); return numbers(2, TypeInfo::number(type.range));
            case TypeInfo::Kind::kColor:
                text("^#[0-9A-Fa-f]{6}$");
                return numbers(3, TypeInfo::number(type.range));
            case TypeInfo::Kind::kNumber: return number(type.range);
            case TypeInfo::Kind::kInteger: return integer(type.range);
            case TypeInfo::Kind::kNumbers: return numbers(type.count, type.items[0]);
            case TypeInfo::Kind::kBool: return plain("boolean");
            case TypeInfo::Kind::kString: return refer_to("text");
            case TypeInfo::Kind::kFile: return refer_to("file");
            case TypeInfo::Kind::kList: return collection("array", "items", type.items[0]);
            case TypeInfo::Kind::kTuple: return tuple(type.items);
            case TypeInfo::Kind::kMap: return collection("object", "additionalProperties", type.items[0]);
            case TypeInfo::Kind::kObject:
                json_.begin_object();
                object(type.fields, {});
                json_.end_object();
                return;
            case TypeInfo::Kind::kInput: return input(type.takes);
            case TypeInfo::Kind::kWord: return words(type.words);
        }
    }

    // What may be picked after a colon: any channels of pixels, what data have by name.
    static std::string selector(const Takes& takes) {
        if (takes.kind != Takes::Kind::kData) return "(:.+)?";
        const DataParts* parts = takes.data ? parts_of_kind(takes.data) : nullptr;
        return parts ? fmt::format("(:({}))?", fmt::join(parts->names, "|")) : "";
    }

    void input(const Takes& takes) {
        const bool is_data = takes.kind == Takes::Kind::kData;
        json_.begin_object().field("type", "string");
        json_.field("pattern", fmt::format("^{}{}$", kIdentifierPattern, selector(takes)));
        if (is_data) json_.field("description", TypeInfo::input(takes, false).text());
        json_.end_object();
    }

    void plain(const char* type) { json_.begin_object().field("type", type).end_object(); }

    void number(const Range& range) { number("number", range.min, range.max); }

    // An int has bounds of its own.
    void integer(const Range& range) {
        constexpr double kMost = std::numeric_limits<int>::max();
        number("integer", std::max(range.min, -kMost), std::min(range.max, kMost));
    }

    void number(const char* type, double min, double max) {
        json_.begin_object().field("type", type);
        if (std::isfinite(min)) json_.field("minimum", min);
        if (std::isfinite(max)) json_.field("maximum", max);
        json_.end_object();
    }

    void numbers(std::size_t count, const TypeInfo& item) {
        json_.begin_object().field("type", "array").key("items");
        any_of_object(item);
        json_.field("minItems", count).field("maxItems", count).end_object();
    }

    void tuple(const std::vector<TypeInfo>& items) {
        json_.begin_object().field("type", "array").key("prefixItems").begin_array();
        for (const TypeInfo& item : items) any_of_object(item);
        json_.end_array().field("minItems", items.size()).field("maxItems", items.size()).end_object();
    }

    void collection(const char* type, const char* of, const TypeInfo& item) {
        json_.begin_object().field("type", type).key(of);
        any_of_object(item);
        json_.end_object();
    }

    JsonWriter& json_;
};

}  // namespace

void write_schema_definitions(JsonWriter& json) {
    ValueSchema values(json);
    json.key("keyline.name");
    values.text(fmt::format("^{}$", kIdentifierPattern));
    json.key("keyline.variable");
    values.text("^" + reference(false) + "$");
    json.key("keyline.template");
    values.text(holds_reference());
    json.key("keyline.expression");
    values.text("^=");
    json.key("keyline.text").begin_object().field("type", "string");
    json.key("not").begin_object().field("pattern", broken_reference()).end_object().end_object();
    json.key("keyline.file").begin_object().field("type", "string").field("minLength", 1);
    json.key("not").begin_object().field("pattern", broken_reference()).end_object().end_object();
    json.field("keyline.keys", parse_json(kKeys, "keys"));
    json.field("keyline.key", parse_json(kKey, "key"));
    json.field("keyline.tangents", parse_json(kTangents, "tangents"));
    json.field("keyline.tangent", parse_json(kTangent, "tangent"));
    json.field("keyline.beyond", parse_json(kBeyond, "beyond"));
}

void write_schema_of_fields(JsonWriter& json, const std::vector<FieldInfo>& fields, const Value& own) {
    ValueSchema(json).object(fields, own);
}

void write_schema_of_property(JsonWriter& json, const FieldInfo& field) { ValueSchema(json).field(field); }

void write_schema_of_words(JsonWriter& json, const std::vector<TypeInfo::WordInfo>& words) {
    ValueSchema(json).words(words);
}

}  // namespace keyline
