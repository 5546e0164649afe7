// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace keyline {

struct Token {
    enum class Kind { kNumber, kText, kName, kSign, kEnd };
    Kind kind = Kind::kEnd;
    std::string text;  // the name; the text without its quotes; the sign; a number as written
    std::size_t at = 0;
    double number = 0;

    bool is_sign(std::string_view sign) const { return kind == Kind::kSign && text == sign; }
    bool is_word(std::string_view word) const { return kind == Kind::kName && text == word; }
};

// What an expression is made of, from the byte `begin` on; the end comes last.  Throws ExpressionFault.
std::vector<Token> tokens_of(std::string_view text, std::size_t begin);

}  // namespace keyline
