// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/json_schema.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <regex>
#include <stdexcept>

namespace keyline::testing {

namespace {

using Kind = Value::Kind;

bool is_of_type(const Value& types, const Value& value) {
    const auto is_it = [&](const Value& type) { return is_of_type(type, value); };
    if (types.is(Kind::kArray)) return std::ranges::any_of(types.items, is_it);
    const std::string& type = types.text;
    if (type == "null") return value.is(Kind::kNull);
    if (type == "boolean") return value.is(Kind::kBool);
    if (type == "number") return value.is(Kind::kNumber);
    if (type == "integer") return value.is(Kind::kNumber) && value.number == std::floor(value.number);
    if (type == "string") return value.is(Kind::kString);
    if (type == "array") return value.is(Kind::kArray);
    if (type == "object") return value.is(Kind::kObject);
    throw std::logic_error("the schema has an unknown type " + type);
}

// Of scalars, which is all that the schema compares.
bool same(const Value& a, const Value& b) {
    if (a.kind != b.kind) return false;
    switch (a.kind) {
        case Kind::kNull: return true;
        case Kind::kBool: return a.boolean == b.boolean;
        case Kind::kNumber: return a.number == b.number;
        case Kind::kString: return a.text == b.text;
        default: throw std::logic_error("the schema compares arrays or objects");
    }
}

// To make one takes longer than to use it many times.
const std::regex& regex_of(const std::string& pattern) {
    static std::map<std::string, std::regex> made;
    return made.try_emplace(pattern, pattern).first->second;
}

bool is_in(const std::string& word, std::initializer_list<const char*> words) {
    return std::ranges::find(words, word) != words.end();
}

}  // namespace

bool JsonSchema::takes(const std::string& definition, const Value& value) const {
    return holds(referred("#/$defs/" + definition), value);
}

const Value& JsonSchema::referred(const std::string& reference) const {
    const std::string start = "#/$defs/";
    const Value* definitions = root_.find("$defs");
    const Value* found = reference.starts_with(start) && definitions
                             ? definitions->find(reference.substr(start.size()))
                             : nullptr;
    if (!found) throw std::logic_error("the schema refers to nothing by " + reference);
    return *found;
}

bool JsonSchema::holds(const Value& schema, const Value& value) const {
    if (schema.is(Kind::kBool)) return schema.boolean;
    return std::ranges::all_of(schema.members,
                               [&](const Member& m) { return keyword_holds(schema, m, value); });
}

int JsonSchema::missing(const Value& schema, const Value& value) const {
    int out = 0;
    for (const Member& m : schema.members) {
        if (m.key == "$ref") out += missing(referred(m.value.text), value);
        if (m.key == "required")
            out += static_cast<int>(std::ranges::count_if(
                m.value.items, [&](const Value& key) { return !value.find(key.text); }));
        if (m.key == "allOf")
            for (const Value& each : m.value.items) out += missing(each, value);
        if (m.key == "if")
            if (const Value* chosen = schema.find(holds(m.value, value) ? "then" : "else"))
                out += missing(*chosen, value);
        if (m.key == "properties" || m.key == "additionalProperties")
            for (const Member& member : value.members) {
                const Value* of_it = m.key == "properties" ? m.value.find(member.key) : &m.value;
                if (of_it) out += missing(*of_it, member.value);
            }
    }
    return out;
}

bool JsonSchema::keyword_holds(const Value& schema, const Member& m, const Value& value) const {
    const auto value_holds = [&](const Value& s) { return holds(s, value); };
    if (is_in(m.key, {"$schema", "$id", "$defs", "title", "description", "default", "then", "else"}))
        return true;
    if (m.key == "type") return is_of_type(m.value, value);
    if (m.key == "const") return same(m.value, value);
    if (m.key == "enum")
        return std::ranges::any_of(m.value.items, [&](const Value& v) { return same(v, value); });
    if (m.key == "$ref") return value_holds(referred(m.value.text));
    if (m.key == "anyOf") return std::ranges::any_of(m.value.items, value_holds);
    if (m.key == "allOf") return std::ranges::all_of(m.value.items, value_holds);
    if (m.key == "not") return !value_holds(m.value);
    if (m.key == "if") {
        const Value* chosen = schema.find(value_holds(m.value) ? "then" : "else");
        return !chosen || value_holds(*chosen);
    }
    if (is_in(m.key, {"minimum", "exclusiveMinimum", "maximum"})) return number_holds(m, value);
    if (is_in(m.key, {"pattern", "minLength"})) return string_holds(m, value);
    if (is_in(m.key, {"items", "prefixItems", "minItems", "maxItems"})) return array_holds(m, value);
    if (is_in(m.key, {"properties", "required", "additionalProperties", "propertyNames", "minProperties"}))
        return object_holds(schema, m, value);
    throw std::logic_error("the schema has an unknown keyword " + m.key);
}

// Each keyword holds for values that it does not speak of.
bool JsonSchema::number_holds(const Member& m, const Value& value) const {
    if (!value.is(Kind::kNumber)) return true;
    if (m.key == "exclusiveMinimum") return value.number > m.value.number;
    return m.key == "minimum" ? value.number >= m.value.number : value.number <= m.value.number;
}

bool JsonSchema::string_holds(const Member& m, const Value& value) const {
    if (!value.is(Kind::kString)) return true;
    if (m.key == "minLength") return static_cast<double>(value.text.size()) >= m.value.number;
    return std::regex_search(value.text, regex_of(m.value.text));
}

bool JsonSchema::array_holds(const Member& m, const Value& value) const {
    if (!value.is(Kind::kArray)) return true;
    const auto count = static_cast<double>(value.items.size());
    if (m.key == "minItems") return count >= m.value.number;
    if (m.key == "maxItems") return count <= m.value.number;
    if (m.key == "items")
        return std::ranges::all_of(value.items, [&](const Value& item) { return holds(m.value, item); });
    for (std::size_t i = 0; i < std::min(value.items.size(), m.value.items.size()); ++i)
        if (!holds(m.value.items[i], value.items[i])) return false;
    return true;
}

bool JsonSchema::object_holds(const Value& schema, const Member& m, const Value& value) const {
    if (!value.is(Kind::kObject)) return true;
    if (m.key == "required")
        return std::ranges::all_of(m.value.items, [&](const Value& key) { return value.find(key.text); });
    if (m.key == "properties")
        return std::ranges::all_of(m.value.members, [&](const Member& property) {
            const Value* v = value.find(property.key);
            return !v || holds(property.value, *v);
        });
    if (m.key == "minProperties") return static_cast<double>(value.members.size()) >= m.value.number;
    const Value* properties = schema.find("properties");
    return std::ranges::all_of(value.members, [&](const Member& member) {
        if (m.key == "additionalProperties")
            return (properties && properties->find(member.key)) || holds(m.value, member.value);
        Value name;
        name.kind = Kind::kString;
        name.text = member.key;
        return holds(m.value, name);
    });
}

}  // namespace keyline::testing
