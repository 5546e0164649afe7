// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/json_writer.h"
#include "engine/reference.h"
#include "engine/registry.h"

#include <cmath>

namespace keyline {

namespace {

// Any value may be a variable, which takes the variable's own type.
constexpr const char* kVariable = "^\\$\\{[^{}]+\\}$";
constexpr const char* kInputPattern = "^([A-Za-z_][A-Za-z0-9_-]*|\\$\\{[^{}]+\\})(:.+)?$";
constexpr const char* kIdPattern = "^[A-Za-z_][A-Za-z0-9_-]*$";

class Schema {
public:
    std::string text() {
        json_.begin_object();
        json_.field("$schema", "https://json-schema.org/draft/2020-12/schema");
        json_.field("title", "Keyline graph");
        json_.field("type", "object");
        json_.key("required").list(std::vector<std::string>{"keyline", "nodes"});
        json_.key("properties").begin_object();
        json_.key("$schema").begin_object().field("type", "string").end_object();
        json_.key("keyline").begin_object().field("const", 1).end_object();
        for (const char* name : {"about", "ocio"})
            json_.key(name).begin_object().field("type", "string").end_object();
        variables();
        nodes();
        json_.end_object().field("additionalProperties", false);
        definitions();
        return json_.end_object().text();
    }

private:
    void variables() {
        json_.key("variables").begin_object().field("type", "object");
        json_.key("propertyNames").begin_object().field("pattern", kIdPattern).end_object();
        json_.end_object();
    }

    void nodes() {
        json_.key("nodes").begin_object().field("type", "object");
        json_.key("propertyNames").begin_object().field("pattern", kIdPattern).end_object();
        json_.key("additionalProperties").begin_object();
        json_.field("type", "object").key("required").list(std::vector<std::string>{"type"});
        json_.key("properties").begin_object().key("type").begin_object();
        json_.key("enum").list(registry().names());
        json_.end_object().end_object();
        json_.key("allOf").begin_array();
        for (const std::string& name : registry().names()) choice(name);
        json_.end_array().end_object().end_object();
    }

    // One object a type, chosen by `type`: an editor that knows it completes and checks just that.
    void choice(const std::string& name) {
        json_.begin_object().key("if").begin_object().key("properties").begin_object();
        json_.key("type").begin_object().field("const", name).end_object();
        json_.end_object().end_object();
        json_.key("then").begin_object().field("$ref", "#/$defs/" + name).end_object().end_object();
    }

    void definitions() {
        json_.key("$defs").begin_object();
        json_.key("variable").begin_object().field("type", "string").field("pattern", kVariable).end_object();
        for (const auto& [name, type] : registry().types()) {
            json_.key(name).begin_object().field("description", type.help).field("type", "object");
            required(type.fields);
            json_.key("properties").begin_object();
            json_.key("type").begin_object().field("const", name).end_object();
            json_.key("about").begin_object().field("type", "string").end_object();
            for (const FieldInfo& f : type.fields) field(f);
            json_.end_object().field("additionalProperties", false).end_object();
        }
        json_.end_object();
    }

    void required(const std::vector<FieldInfo>& fields) {
        std::vector<std::string> names;
        for (const FieldInfo& f : fields)
            if (f.required) names.push_back(f.name);
        if (!names.empty()) json_.key("required").list(names);
    }

    void field(const FieldInfo& f) {
        json_.key(f.name).begin_object().field("description", f.help);
        if (!f.required && !f.default_value.is(Value::Kind::kNull)) json_.field("default", f.default_value);
        json_.key("anyOf").begin_array();
        choices(f.type);
        if (f.type.optional) json_.begin_object().field("type", "null").end_object();
        json_.begin_object().field("$ref", "#/$defs/variable").end_object();
        json_.end_array().end_object();
    }

    // The items of an "anyOf".
    void choices(const TypeInfo& type) {
        switch (type.kind) {
            case TypeInfo::Kind::kAnyOf:
                for (const TypeInfo& item : type.items) choices(item);
                return;
            case TypeInfo::Kind::kPair: number(type.range, "number"); return numbers(2, type.range);
            case TypeInfo::Kind::kColor:
                json_.begin_object()
                    .field("type", "string")
                    .field("pattern", "^#[0-9A-Fa-f]{6}$")
                    .end_object();
                return numbers(3, type.range);
            default: return single(type);
        }
    }

    void single(const TypeInfo& type) {
        switch (type.kind) {
            case TypeInfo::Kind::kNumber: return number(type.range, "number");
            case TypeInfo::Kind::kInteger: return number(type.range, "integer");
            case TypeInfo::Kind::kNumbers: return numbers(type.count, type.range);
            case TypeInfo::Kind::kBool: return plain("boolean");
            case TypeInfo::Kind::kList: return collection("array", "items", type.items[0]);
            case TypeInfo::Kind::kTuple: return collection("array", "items", TypeInfo::any_of(type.items));
            case TypeInfo::Kind::kMap: return collection("object", "additionalProperties", type.items[0]);
            case TypeInfo::Kind::kObject: return object(type.fields);
            case TypeInfo::Kind::kInput:
                json_.begin_object().field("type", "string").field("pattern", kInputPattern).end_object();
                return;
            case TypeInfo::Kind::kWord: return word(type);
            default: return plain("string");
        }
    }

    void plain(const char* type) { json_.begin_object().field("type", type).end_object(); }

    void number(const Range& range, const char* type) {
        json_.begin_object().field("type", type);
        if (std::isfinite(range.min)) json_.field("minimum", range.min);
        if (std::isfinite(range.max)) json_.field("maximum", range.max);
        json_.end_object();
    }

    void numbers(std::size_t count, const Range& range) {
        json_.begin_object().field("type", "array").key("items");
        number(range, "number");
        json_.field("minItems", count).field("maxItems", count).end_object();
    }

    void word(const TypeInfo& type) {
        std::vector<std::string> words;
        for (const TypeInfo::WordInfo& w : type.words) words.push_back(w.word);
        json_.begin_object().key("enum").list(words).end_object();
    }

    void collection(const char* type, const char* of, const TypeInfo& item) {
        json_.begin_object().field("type", type).key(of).begin_object().key("anyOf").begin_array();
        choices(item);
        json_.begin_object().field("$ref", "#/$defs/variable").end_object();
        json_.end_array().end_object().end_object();
    }

    void object(const std::vector<FieldInfo>& fields) {
        json_.begin_object().field("type", "object");
        required(fields);
        json_.key("properties").begin_object();
        for (const FieldInfo& f : fields) field(f);
        json_.end_object().field("additionalProperties", false).end_object();
    }

    JsonWriter json_{JsonWriter::Style::kIndented};
};

}  // namespace

std::string schema_json() { return Schema().text(); }

}  // namespace keyline
