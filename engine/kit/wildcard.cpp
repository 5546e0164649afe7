// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/wildcard.h"

#include <cstddef>

namespace keyline {

bool matches(std::string_view name, std::string_view pattern) {
    const auto is_star = [&](std::size_t p) {
        return p < pattern.size() && pattern[p] == '*' && (p == 0 || pattern[p - 1] != '\\');
    };
    // The pattern's next character as it stands in a name: the backslash before a star is none.
    const auto literal = [&](std::size_t p) {
        return p + 1 < pattern.size() && pattern[p] == '\\' && pattern[p + 1] == '*' ? p + 1 : p;
    };
    std::size_t t = 0, p = 0, star = std::string_view::npos, resume = 0;
    while (t < name.size()) {
        if (is_star(p)) {
            star = p++;
            resume = t;
        } else if (const std::size_t c = literal(p); c < pattern.size() && pattern[c] == name[t]) {
            p = c + 1, ++t;
        } else if (star != std::string_view::npos) {
            p = star + 1;
            t = ++resume;
        } else {
            return false;
        }
    }
    while (is_star(p)) ++p;
    return p == pattern.size();
}

}  // namespace keyline
