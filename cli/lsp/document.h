// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cli/lsp/text.h"
#include "engine/json/json_tree.h"
#include "engine/json/value.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace keyline::lsp {

// A file of the editor's, as it is typed.
class Document {
public:
    Document(std::string uri, Text text);

    const std::string& uri() const { return uri_; }
    const std::filesystem::path& file() const { return file_; }
    std::filesystem::path folder() const { return file_.parent_path(); }
    const Text& text() const { return text_; }
    const JsonTree& root() const { return tree_.root; }
    const Value& value() const { return value_; }                 // as far as it is whole
    const std::optional<Error>& fault() const { return fault_; }  // why it is no JSON

    std::string_view of(Span span) const { return span.of(text_.all()); }
    std::string string_of(Span span) const;  // a key or a string without its quotes

    // A member of an object; null where there is none.
    const JsonItem* member(const JsonTree& object, std::string_view key) const;
    // One of the whole: "nodes", "variables"; null where that is none, or no object.
    const JsonTree* section(std::string_view key) const;

private:
    std::string uri_;
    std::filesystem::path file_;
    Text text_;
    JsonDocument tree_;
    Value value_;
    std::optional<Error> fault_;
};

std::filesystem::path path_of_uri(std::string_view uri);
std::string uri_of_path(const std::filesystem::path& path);

}  // namespace keyline::lsp
