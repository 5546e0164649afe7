// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/lsp/answers.h"
#include "cli/lsp/site.h"
#include "engine/base/identifier.h"
#include "engine/graph/group_search.h"

namespace keyline::lsp {

namespace {

void write_location(JsonWriter& json, const Document& document, Span span) {
    json.begin_object().field("uri", document.uri()).key("range");
    document.text().write_range(json, span);
    json.end_object();
}

// The file of the group whose name the cursor is in; empty where it is in none.
std::filesystem::path group_at(const Document& document, std::size_t byte) {
    const Site site = site_at(document, byte);
    const bool is_type =
        site.item && site.path.size() == 3 && document.string_of(site.path[2]->key) == "type";
    const std::string name = is_type ? document.string_of(site.item->value.span) : "";
    return is_type ? group_file(name, document.folder()) : std::filesystem::path();
}

std::vector<Mention> same_as_at(const Document& document, std::size_t byte) {
    std::vector<Mention> all = mentions_in(document);
    const Mention* at = mention_at(all, byte);
    if (!at) return {};
    const Mention wanted = *at;
    std::erase_if(all, [&](const Mention& m) { return !m.is_same(wanted); });
    return all;
}

}  // namespace

std::string definition(const Known& known, std::size_t byte) {
    JsonWriter json;
    json.begin_array();
    for (const Mention& m : same_as_at(known.document, byte))
        if (m.is_definition) write_location(json, known.document, m.span);
    if (const auto file = group_at(known.document, byte); !file.empty()) {
        const Document group(uri_of_path(std::filesystem::absolute(file).lexically_normal()), Text(""));
        write_location(json, group, {});
    }
    return json.end_array().text();
}

std::string references(const Known& known, std::size_t byte) {
    JsonWriter json;
    json.begin_array();
    for (const Mention& m : same_as_at(known.document, byte)) write_location(json, known.document, m.span);
    return json.end_array().text();
}

std::string rename_range(const Known& known, std::size_t byte) {
    for (const Mention& m : same_as_at(known.document, byte))
        if (m.span.touches(byte)) {
            JsonWriter json;
            known.document.text().write_range(json, m.span);
            return json.text();
        }
    return "null";
}

std::string renamed(const Known& known, std::size_t byte, const std::string& name) {
    if (!is_identifier(name))
        fail(ErrorKind::kGraph, in_quotes(name) + " is no name", "a name is " + std::string(kIdentifierForm));
    const std::vector<Mention> same = same_as_at(known.document, byte);
    for (const Mention& m : mentions_in(known.document))
        if (!same.empty() && m.is_definition && m.of == same.front().of && m.name == name &&
            m.name != same.front().name)
            fail(ErrorKind::kGraph, "there is another " + in_quotes(name));
    JsonWriter json;
    json.begin_object().key("changes").begin_object().key(known.document.uri()).begin_array();
    for (const Mention& m : same) {
        json.begin_object().key("range");
        known.document.text().write_range(json, m.span);
        json.field("newText", name).end_object();
    }
    return json.end_array().end_object().end_object().text();
}

}  // namespace keyline::lsp
