// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/lsp/answers.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>
#include <string_view>

// What an error suggests, done: its hint and its text say what, its place says where.

namespace keyline::lsp {

namespace {

struct Edit {
    std::string title;
    Span span;
    std::string text;
};

// What stands between two pieces of a text.
std::optional<std::string> between(std::string_view text, std::string_view before, std::string_view after) {
    const std::size_t begin = text.find(before);
    if (begin == std::string_view::npos) return std::nullopt;
    text.remove_prefix(begin + before.size());
    const std::size_t end = text.find(after);
    return end == std::string_view::npos ? std::nullopt : std::optional(std::string(text.substr(0, end)));
}

// The word that the error is about, in the token at its place: all that it quotes is tried.
std::optional<Span> wrong_word(const Document& document, const Error& error, Span token) {
    const std::string_view text = document.of(token);
    for (const char quote : {'\'', '"'})
        for (std::size_t at = error.what.find(quote); at != std::string::npos;
             at = error.what.find(quote, at + 1)) {
            const std::size_t end = error.what.find(quote, at + 1);
            if (end == std::string::npos) break;
            const std::string word = error.what.substr(at + 1, end - at - 1);
            const std::size_t found = word.empty() ? std::string_view::npos : text.find(word);
            if (found != std::string_view::npos)
                return Span{token.begin + found, token.begin + found + word.size()};
        }
    return std::nullopt;
}

std::optional<Edit> replacement(const Document& document, const Error& error) {
    auto meant = between(error.hint, "did you mean '", "'?");
    if (!meant) meant = between(error.hint, "' is '", "' here");
    if (meant && meant->find('\'') != std::string::npos) return std::nullopt;  // one of several
    const auto word = meant ? wrong_word(document, error, span_of(document, error)) : std::nullopt;
    if (!word) return std::nullopt;
    return Edit{fmt::format("Write '{}'", *meant), *word, *meant};
}

// A member of the node whose key is at the error's place, after its type.
std::optional<Edit> member(const Document& document, const Error& error, const std::string& title,
                           const std::string& key, const std::string& value) {
    const JsonTree* nodes = document.section("nodes");
    if (!nodes) return std::nullopt;
    const Span at = span_of(document, error);
    const auto node =
        std::ranges::find_if(nodes->items, [&](const JsonItem& i) { return i.key.begin == at.begin; });
    const JsonItem* type = node == nodes->items.end() ? nullptr : document.member(node->value, "type");
    if (!type || document.member(node->value, key)) return std::nullopt;
    const std::size_t end = type->value.span.end;
    return Edit{title, {end, end}, fmt::format(", \"{}\": {}", key, value)};
}

std::optional<Edit> insertion(const Document& document, const Error& error) {
    const bool is_input = error.what.starts_with("input '");
    const auto name = between(error.what, is_input ? "input '" : "parameter '", "' is missing");
    if (!name) return std::nullopt;
    return member(document, error, fmt::format("Add '{}'", *name), *name, is_input ? "\"\"" : "null");
}

std::optional<Edit> meaning(const Document& document, const Error& warning) {
    if (!can_be_meant(warning.code) || warning.node.empty()) return std::nullopt;
    return member(document, warning, fmt::format("Say that '{}' is meant", code_name(warning.code)), "meant",
                  fmt::format("\"{}\"", code_name(warning.code)));
}

void write(JsonWriter& json, const Document& document, const Edit& edit) {
    json.begin_object().field("title", edit.title).field("kind", "quickfix").key("edit").begin_object();
    json.key("changes").begin_object().key(document.uri()).begin_array().begin_object().key("range");
    document.text().write_range(json, edit.span);
    json.field("newText", edit.text).end_object().end_array().end_object().end_object().end_object();
}

}  // namespace

std::string actions(const Known& known, Span range) {
    JsonWriter json;
    json.begin_array();
    const auto is_asked_for = [&](const Error& e) {
        const Span span = span_of(known.document, e);
        return span.end >= range.begin && range.end >= span.begin;
    };
    for (const Error& w : known.analysis.diagnostics.warnings())
        if (const auto edit = is_asked_for(w) ? meaning(known.document, w) : std::nullopt)
            write(json, known.document, *edit);
    for (const Error& e : known.analysis.diagnostics.errors()) {
        if (!is_asked_for(e)) continue;
        if (const auto edit = replacement(known.document, e)) write(json, known.document, *edit);
        if (const auto edit = insertion(known.document, e)) write(json, known.document, *edit);
    }
    return json.end_array().text();
}

}  // namespace keyline::lsp
