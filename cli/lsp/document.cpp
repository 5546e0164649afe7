// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/lsp/document.h"

#include "engine/json/json_reader.h"
#include "engine/json/json_repair.h"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <utility>

namespace keyline::lsp {

Document::Document(std::string uri, Text text)
    : uri_(std::move(uri)),
      file_(path_of_uri(uri_)),
      text_(std::move(text)),
      tree_(read_json_tree(text_.all())),
      value_(read_what_is_whole(tree_, text_.all(), file_.string())) {
    try {
        parse_json(text_.all(), file_.string());
    } catch (const Failure& f) {
        fault_ = f.error();
    }
}

std::string Document::string_of(Span span) const { return json_string(of(span)); }

const JsonItem* Document::member(const JsonTree& object, std::string_view key) const {
    const auto it =
        std::ranges::find_if(object.items, [&](const JsonItem& i) { return string_of(i.key) == key; });
    return it == object.items.end() ? nullptr : &*it;
}

const JsonTree* Document::section(std::string_view key) const {
    const JsonItem* item = member(root(), key);
    return item && item->value.is(JsonTree::Kind::kObject) ? &item->value : nullptr;
}

std::filesystem::path path_of_uri(std::string_view uri) {
    constexpr std::string_view kFile = "file://";
    if (uri.starts_with(kFile)) uri.remove_prefix(kFile.size());
    std::string out;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        char* end = nullptr;
        const std::string digits(uri.substr(i + 1, 2));
        const long code = uri[i] == '%' && digits.size() == 2 ? std::strtol(digits.c_str(), &end, 16) : 0;
        const bool is_code = end == digits.c_str() + 2 && end != nullptr;
        out += is_code ? static_cast<char>(code) : uri[i];
        i += is_code ? 2 : 0;
    }
    return out;
}

std::string uri_of_path(const std::filesystem::path& path) {
    std::string out = "file://";
    for (const char c : path.string()) {
        const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                              std::string_view("-._~/").find(c) != std::string_view::npos;
        out += is_plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
    return out;
}

}  // namespace keyline::lsp
