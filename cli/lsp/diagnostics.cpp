// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/lsp/answers.h"
#include "engine/graph/group_search.h"
#include "engine/json/json_repair.h"

#include <algorithm>

namespace keyline::lsp {

namespace {

constexpr int kErrorSeverity = 1, kWarningSeverity = 2;

// A key, a string or a word; a bracket is one by itself.
Span token_at(const std::string& text, std::size_t at) {
    std::size_t end = at;
    if (at < text.size() && text[at] == '"') {
        for (++end; end < text.size() && text[end] != '"' && text[end] != '\n';)
            end += text[end] == '\\' ? 2 : 1;
        ++end;
    } else {
        end = std::min(text.find_first_of(" \t\r\n,:{}[]\"", at), text.size());
    }
    return {at, std::min(std::max(end, at + 1), text.size())};
}

// The node whose type is the file; the whole's first character where none is.
Span use_of(const Document& document, const std::string& file) {
    if (const JsonTree* nodes = document.section("nodes"))
        for (const JsonItem& node : nodes->items) {
            const JsonItem* type = document.member(node.value, "type");
            if (!type) continue;
            const std::string name = document.string_of(type->value.span);
            if (group_file(name, document.folder()) == std::filesystem::path(file)) return type->value.span;
        }
    return {0, std::min<std::size_t>(1, document.text().all().size())};
}

// What stands in a node that is half typed is not told yet, but for what is wrong with the text.
bool is_half_typed(const Document& document, Span span) {
    if (document.fault() && span.begin == document.root().span.begin) return true;  // of the whole
    const JsonTree* nodes = document.fault() ? document.section("nodes") : nullptr;
    return nodes && std::ranges::any_of(nodes->items, [&](const JsonItem& node) {
               return node.key.begin <= span.begin &&
                      span.end <= std::max(node.value.span.end, node.key.end) &&
                      is_torn(node.value, document.text().all());
           });
}

void write(JsonWriter& json, const Document& document, const Error& error, int severity) {
    json.begin_object().key("range");
    document.text().write_range(json, span_of(document, error));
    json.field("severity", severity).field("source", "keyline").field("code", code_of(error));
    const bool is_elsewhere = !error.place.file.empty() && error.place.file != document.file().string();
    std::string message = is_elsewhere ? error.place.text() + ": " : "";
    message += error.what + (error.hint.empty() ? "" : "; " + error.hint);
    json.field("message", message).end_object();
}

}  // namespace

Span span_of(const Document& document, const Error& error) {
    const bool is_here = error.place.line > 0 && error.place.file == document.file().string();
    if (!is_here) return use_of(document, error.place.file);
    return token_at(document.text().all(), document.text().byte_of(error.place));
}

std::string diagnostics(const Known& known) {
    const Document& document = known.document;
    JsonWriter json;
    json.begin_array();
    if (document.fault()) write(json, document, *document.fault(), kErrorSeverity);
    for (const Error& e : known.analysis.diagnostics.errors())
        if (!is_half_typed(document, span_of(document, e))) write(json, document, e, kErrorSeverity);
    for (const Error& w : known.analysis.diagnostics.warnings()) write(json, document, w, kWarningSeverity);
    return json.end_array().text();
}

}  // namespace keyline::lsp
