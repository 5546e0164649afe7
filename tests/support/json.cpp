// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/json.h"

#include <algorithm>
#include <fmt/format.h>

namespace keyline::testing {

namespace {

std::string quoted(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        out += c;
    }
    return out + '"';
}

std::string unquoted(const std::string& text) {
    std::string out;
    for (std::size_t i = 1; i + 1 < text.size(); ++i) out += text[i] == '\\' ? text[++i] : text[i];
    return out;
}

}  // namespace

Json::Json(std::initializer_list<Json> items) {
    const bool object = items.size() > 0 && std::ranges::all_of(items, &Json::is_pair);
    kind_ = object ? Kind::kObject : Kind::kArray;
    for (const Json& item : items) {
        if (object)
            set(unquoted(item.members_[0].second.text_), item.members_[1].second);
        else
            members_.emplace_back("", item);
    }
}

Json::Json(const std::string& text) : kind_(Kind::kText), is_key_(true), text_(quoted(text)) {}

Json Json::number_from(double number) { return {Kind::kText, fmt::format("{}", number)}; }

Json Json::array(std::vector<Json> items) {
    Json out(Kind::kArray, "");
    for (Json& item : items) out.members_.emplace_back("", std::move(item));
    return out;
}

Json& Json::set(const std::string& key, Json value) {
    const auto it = std::ranges::find(members_, key, &std::pair<std::string, Json>::first);
    if (it != members_.end())
        it->second = std::move(value);
    else
        members_.emplace_back(key, std::move(value));
    return *this;
}

bool Json::has(const std::string& key) const {
    return std::ranges::find(members_, key, &std::pair<std::string, Json>::first) != members_.end();
}

std::string Json::text(int level) const {
    if (kind_ == Kind::kText) return text_;
    if (members_.empty()) return kind_ == Kind::kArray ? "[]" : "{}";
    std::string out;
    for (const auto& [key, value] : members_) {
        if (!out.empty()) out += kind_ == Kind::kArray ? ", " : ",\n";
        if (kind_ == Kind::kObject) out += fmt::format("{:{}}{}: ", "", level + 1, quoted(key));
        out += value.text(level + 1);
    }
    return kind_ == Kind::kArray ? "[" + out + "]" : fmt::format("{{\n{}\n{:{}}}}", out, "", level);
}

}  // namespace keyline::testing
