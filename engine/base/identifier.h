// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"

#include <algorithm>
#include <string_view>

namespace KEYLINE_API keyline {

// What the id of a node and the name of a variable look like, in every locale.
inline constexpr std::string_view kIdentifierPattern = "[A-Za-z_][A-Za-z0-9_-]*";
inline constexpr std::string_view kIdentifierForm = "a letter or _, then letters, digits, _ and -";

inline bool is_identifier(std::string_view text) {
    const auto is_start = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
    const auto is_part = [&](char c) { return is_start(c) || (c >= '0' && c <= '9') || c == '-'; };
    return !text.empty() && is_start(text[0]) && std::ranges::all_of(text, is_part);
}

}  // namespace keyline
