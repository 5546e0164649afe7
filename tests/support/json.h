// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <concepts>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

namespace keyline::testing {

// JSON as it is written in C++, for parameters and graphs:
//
//     {{"radius", 1}, {"shape", "square"}, {"sigma", {2.5, 0}}}
//
// A list of pairs that each begin with a string is an object, every other list an array, and {} an object.
class Json {
public:
    Json() = default;
    Json(std::initializer_list<Json> items);                   // NOLINT(google-explicit-constructor)
    Json(bool b) : Json(Kind::kText, b ? "true" : "false") {}  // NOLINT(google-explicit-constructor)
    Json(const char* text) : Json(std::string(text)) {}        // NOLINT(google-explicit-constructor)
    Json(const std::string& text);                             // NOLINT(google-explicit-constructor)
    template <class N>
    requires(std::integral<N> || std::floating_point<N>) && (!std::same_as<N, bool>)Json(N number)
        : Json(number_from(static_cast<double>(number))) {}  // NOLINT(google-explicit-constructor)

    static Json array(std::vector<Json> items = {});
    static Json verbatim(std::string json) { return {Kind::kText, std::move(json)}; }

    // Replaces an object's member, or adds it at the end.
    Json& set(const std::string& key, Json value);
    bool has(const std::string& key) const;

    // Objects have a line for each member, indented by a blank a level; arrays stand on one line.
    std::string text(int level = 0) const;

private:
    enum class Kind { kText, kArray, kObject };
    Json(Kind kind, std::string text) : kind_(kind), text_(std::move(text)) {}
    static Json number_from(double number);
    bool is_pair() const {
        return kind_ == Kind::kArray && members_.size() == 2 && members_[0].second.is_key_;
    }

    Kind kind_ = Kind::kObject;
    bool is_key_ = false;                                // a string
    std::string text_;                                   // kText: as JSON
    std::vector<std::pair<std::string, Json>> members_;  // kArray: without keys
};

}  // namespace keyline::testing
