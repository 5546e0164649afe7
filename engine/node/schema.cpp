// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/base/identifier.h"
#include "engine/json/json_writer.h"
#include "engine/node/reference.h"
#include "engine/node/registry.h"
#include "engine/params/computed.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace keyline {

namespace {

// Any value may be a variable, which takes the variable's own type.
constexpr const char* kVariable = "^\\$\\{[^{}]+\\}$";
constexpr const char* kExpression = "^=";
constexpr const char* kGroup = "\\.json$";

std::string id_pattern() { return fmt::format("^{}$", kIdentifierPattern); }

std::string input_pattern(bool is_data) {
    return fmt::format("^({}|\\$\\{{[^{{}}]+\\}}){}$", kIdentifierPattern, is_data ? "" : "(:.+)?");
}

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
        include();
        json_.key("frames").begin_object().field("type", "string").end_object();
        json_.key("fps").begin_object().field("type", "number").field("exclusiveMinimum", 0).end_object();
        nodes();
        json_.end_object().field("additionalProperties", false);
        definitions();
        return json_.end_object().text();
    }

private:
    void variables() {
        json_.key("variables").begin_object().field("type", "object");
        json_.key("propertyNames").begin_object().field("pattern", id_pattern()).end_object();
        json_.end_object();
    }

    void include() {
        json_.key("include").begin_object().key("anyOf").begin_array();
        file();
        json_.begin_object().field("type", "array").key("items");
        file();
        json_.end_object().end_array().end_object();
    }

    void nodes() {
        json_.key("nodes").begin_object().field("type", "object");
        json_.key("propertyNames").begin_object().field("pattern", id_pattern()).end_object();
        json_.key("additionalProperties").begin_object();
        json_.field("type", "object").key("required").list(std::vector<std::string>{"type"});
        json_.key("properties").begin_object().key("type").begin_object();
        json_.key("anyOf").begin_array();
        json_.begin_object().key("enum").list(registry().names()).end_object();
        text(kGroup);
        json_.end_array().end_object().end_object();
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
        json_.key("expression").begin_object().field("type", "string");
        json_.field("pattern", kExpression).end_object();
        keys();
        for (const auto& [name, type] : registry().types()) {
            json_.key(name).begin_object().field("description", type.help).field("type", "object");
            required(type.fields);
            json_.key("properties").begin_object();
            json_.key("type").begin_object().field("const", name).end_object();
            json_.key("about").begin_object().field("type", "string").end_object();
            json_.key("enabled").begin_object();
            any_of(TypeInfo::boolean());
            json_.end_object();
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
        any_of(f.type);
        json_.end_object();
    }

    // All that may stand for a value of the type: what validate() passes, and a variable.
    void any_of(const TypeInfo& type) {
        json_.key("anyOf").begin_array();
        choices(type);
        refer_to("variable");
        if (takes_expressions(type)) refer_to("expression");
        if (takes_keys(type)) refer_to("keys");
        json_.end_array();
    }

    void refer_to(const char* definition) {
        json_.begin_object().field("$ref", fmt::format("#/$defs/{}", definition)).end_object();
    }

    // A value that moves.
    void keys() {
        json_.key("keys").begin_object().field("type", "object");
        json_.key("required").list(std::vector<std::string>{"keys"});
        json_.key("properties").begin_object();
        json_.key("keys").begin_object().field("type", "array").field("minItems", 1);
        json_.key("items").begin_object().field("type", "array");
        json_.field("minItems", 2).field("maxItems", 3).end_object().end_object();
        for (const char* end : {"before", "after"})
            json_.key(end)
                .begin_object()
                .key("enum")
                .list(std::vector<std::string>{"hold", "loop", "extend"})
                .end_object();
        json_.key("on").begin_object().field("type", "integer").field("minimum", 1).end_object();
        json_.end_object().field("additionalProperties", false).end_object();
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
            case TypeInfo::Kind::kString: return plain("string");
            case TypeInfo::Kind::kFile: return file();
            case TypeInfo::Kind::kList: return collection("array", "items", type.items[0]);
            case TypeInfo::Kind::kTuple: return tuple(type.items);
            case TypeInfo::Kind::kMap: return collection("object", "additionalProperties", type.items[0]);
            case TypeInfo::Kind::kObject: return object(type.fields);
            case TypeInfo::Kind::kInput: return input(type.takes);
            case TypeInfo::Kind::kWord: return word(type);
        }
    }

    // Data have no channels to pick after a colon.
    void input(const Takes& takes) {
        const bool is_data = takes.kind == Takes::Kind::kData;
        json_.begin_object().field("type", "string");
        json_.field("pattern", input_pattern(is_data));
        if (is_data) json_.field("description", TypeInfo::input(takes, false).text());
        json_.end_object();
    }

    void plain(const char* type) { json_.begin_object().field("type", type).end_object(); }

    void text(const char* pattern) {
        json_.begin_object().field("type", "string").field("pattern", pattern).end_object();
    }

    // What is in a name only the program knows.
    void file() { json_.begin_object().field("type", "string").field("minLength", 1).end_object(); }

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

    void word(const TypeInfo& type) {
        std::vector<std::string> words;
        for (const TypeInfo::WordInfo& w : type.words) words.push_back(w.word);
        json_.begin_object().key("enum").list(words).end_object();
    }

    void collection(const char* type, const char* of, const TypeInfo& item) {
        json_.begin_object().field("type", type).key(of);
        any_of_object(item);
        json_.end_object();
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
