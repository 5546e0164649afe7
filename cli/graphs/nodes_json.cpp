// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/graphs/nodes_json.h"

#include "engine/json/json_writer.h"

namespace keyline::cli {

namespace {

void write_words(JsonWriter& json, const std::vector<TypeInfo::WordInfo>& words) {
    json.key("words").begin_array();
    for (const TypeInfo::WordInfo& w : words)
        json.begin_object().field("word", w.word).field("help", w.help).end_object();
    json.end_array();
}

void write_field(JsonWriter& json, const FieldInfo& field) {
    json.begin_object().field("name", field.name).field("help", field.help);
    json.field("type", field.type.text());
    if (const std::string range = field.type.range_text(); !range.empty()) json.field("range", range);
    if (!field.type.words.empty()) write_words(json, field.type.words);
    json.field("input", field.type.kind == TypeInfo::Kind::kInput).field("required", field.required);
    if (!field.required) json.field("default", field.default_value);
    json.end_object();
}

void write_type(JsonWriter& json, const NodeType& type) {
    json.begin_object().field("name", type.name).field("help", type.help).field("version", type.version);
    const std::string pixels = type.kind == NodeKind::kSink ? "nothing" : "pixels";
    json.field("kind", node_kind_name(type.kind)).field("gives", type.gives.empty() ? pixels : type.gives);
    json.key("outputs").list(type.outputs).key("takes").begin_array();
    for (const FieldInfo& field : type.fields) write_field(json, field);
    json.end_array().end_object();
}

}  // namespace

std::string nodes_json(std::span<const NodeType> types) {
    JsonWriter json(JsonWriter::Style::kIndented);
    json.begin_array();
    for (const NodeType& type : types) write_type(json, type);
    return json.end_array().text() + "\n";
}

}  // namespace keyline::cli
