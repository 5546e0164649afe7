// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/graphs/messages.h"

#include "engine/io/versions.h"
#include "engine/json/json_writer.h"

namespace keyline::cli {

namespace {

void write_place(JsonWriter& json, const Place& place) {
    if (place.file.empty()) return;
    json.key("place").begin_object().field("file", place.file);
    if (place.line > 0) json.field("line", place.line).field("column", place.column);
    json.end_object();
}

void write_message(JsonWriter& json, const char* severity, const Error& e) {
    json.begin_object().field("severity", severity).field("kind", reason_of(e)).field("code", code_of(e));
    write_place(json, e.place);
    if (!e.node.empty()) json.field("node", e.node);
    json.field("what", e.what);
    if (!e.hint.empty()) json.field("hint", e.hint);
    json.end_object();
}

std::string sentence(const Error& e) {
    return (e.node.empty() ? "" : e.node + ": ") + e.what + (e.hint.empty() ? "" : "; " + e.hint);
}

// Of an address only what may stand in one.
std::string address(const std::string& file) {
    static constexpr std::string_view kPlain =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/";
    static constexpr const char* kDigits = "0123456789ABCDEF";
    std::string out = file.starts_with('/') ? "file://" : "";
    for (const char c : file) {
        if (kPlain.find(c) != std::string_view::npos) {
            out += c;
            continue;
        }
        const auto byte = static_cast<unsigned char>(c);
        out += {'%', kDigits[byte / 16], kDigits[byte % 16]};
    }
    return out;
}

// What no graph's line is about, an option or a file, stands at the graph.
void write_result(JsonWriter& json, const std::string& graph, const char* level, const Error& e) {
    const bool has_line = e.place.line > 0;
    json.begin_object().field("ruleId", code_of(e)).field("level", level);
    json.key("message").begin_object().field("text", sentence(e)).end_object();
    json.key("locations").begin_array().begin_object().key("physicalLocation").begin_object();
    json.key("artifactLocation")
        .begin_object()
        .field("uri", address(has_line ? e.place.file : graph))
        .end_object();
    if (has_line)
        json.key("region")
            .begin_object()
            .field("startLine", e.place.line)
            .field("startColumn", e.place.column)
            .end_object();
    json.end_object().end_object().end_array().end_object();
}

template <class Write>
void write_all(const Diagnostics& diagnostics, const Write& write) {
    for (const Error& e : diagnostics.errors()) write("error", e);
    for (const Error& w : diagnostics.warnings()) write("warning", w);
}

}  // namespace

std::string messages_json(const std::vector<CheckedGraph>& graphs) {
    JsonWriter json(JsonWriter::Style::kIndented);
    json.begin_array();
    for (const CheckedGraph& graph : graphs) {
        json.begin_object().field("graph", graph.file).field("ok", graph.diagnostics.ok());
        json.key("messages").begin_array();
        write_all(graph.diagnostics,
                  [&](const char* severity, const Error& e) { write_message(json, severity, e); });
        json.end_array().end_object();
    }
    return json.end_array().text() + "\n";
}

std::string messages_sarif(const std::vector<CheckedGraph>& graphs) {
    JsonWriter json(JsonWriter::Style::kIndented);
    json.begin_object()
        .field("$schema", "https://json.schemastore.org/sarif-2.1.0.json")
        .field("version", "2.1.0");
    json.key("runs").begin_array().begin_object();
    json.key("tool").begin_object().key("driver").begin_object();
    json.field("name", "keyline").field("version", keyline_version()).end_object().end_object();
    json.field("columnKind", "unicodeCodePoints").key("results").begin_array();
    for (const CheckedGraph& graph : graphs)
        write_all(graph.diagnostics,
                  [&](const char* level, const Error& e) { write_result(json, graph.file, level, e); });
    return json.end_array().end_object().end_array().end_object().text() + "\n";
}

}  // namespace keyline::cli
