// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/expr/tokens.h"

#include "engine/base/text.h"
#include "engine/expr/expression.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <fmt/format.h>
#include <utility>

namespace keyline {

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

// What other languages write, and how it is written here.
constexpr std::array kElsewhere{
    std::pair{"&&", "and is written 'and'"},
    std::pair{"||", "or is written 'or'"},
    std::pair{"**", "a power is written '^'"},
    std::pair{"//", "the whole part of a quotient is floor(a / b)"},
    std::pair{"!", "not is written 'not'"},
    std::pair{"=", "two values are compared with '=='"},
    std::pair{"\"", "text stands in single quotes"},
    std::pair{"×", "it is written '*'"},
    std::pair{"÷", "it is written '/'"},
    std::pair{"−", "it is written '-'"},
    std::pair{"≤", "it is written '<='"},
    std::pair{"≥", "it is written '>='"},
    std::pair{"$", "a name stands for itself, or in ${…}"},
};

constexpr std::array<std::string_view, 18> kSigns{"<=", ">=", "==", "!=", "+", "-", "*", "/", "%",
                                                  "^",  "<",  ">",  "?",  ":", "(", ")", "[", "]"};

class Lexer {
public:
    Lexer(std::string_view text, std::size_t begin) : text_(text), at_(begin) {}

    std::vector<Token> tokens() {
        std::vector<Token> out;
        while (true) {
            while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
            if (at_ == text_.size()) break;
            out.push_back(next());
        }
        out.push_back({Token::Kind::kEnd, {}, text_.size()});
        return out;
    }

private:
    std::string_view rest() const { return text_.substr(at_); }
    char after(std::size_t n) const { return at_ + n < text_.size() ? text_[at_ + n] : '\0'; }

    Token next() {
        if (is_digit(text_[at_]) || (text_[at_] == '.' && is_digit(after(1)))) return number();
        if (is_letter(text_[at_])) return name();
        if (text_[at_] == '\'') return quoted('\'', Token::Kind::kText, 1);
        if (rest().starts_with("${")) return quoted('}', Token::Kind::kName, 2);
        return sign();
    }

    Token take(Token::Kind kind, std::size_t length) {
        Token token{kind, std::string(text_.substr(at_, length)), at_};
        at_ += length;
        return token;
    }

    Token number() {
        double value = 0;
        const auto [stop, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
        const auto length = static_cast<std::size_t>(stop - text_.data()) - at_;
        std::size_t word = length;
        while (is_letter(after(word)) || is_digit(after(word)) || after(word) == '.') ++word;
        if (word > length || error != std::errc())
            throw ExpressionFault(at_, fmt::format("{} is no number", in_quotes(text_.substr(at_, word))));
        Token token = take(Token::Kind::kNumber, length);
        token.number = value;
        return token;
    }

    // With the part after a dot: data.width.
    Token name() {
        std::size_t length = 1;
        while (is_letter(after(length)) || is_digit(after(length)) ||
               (after(length) == '.' && is_letter(after(length + 1))))
            ++length;
        return take(Token::Kind::kName, length);
    }

    Token quoted(char close, Token::Kind kind, std::size_t opening) {
        const std::size_t end = text_.find(close, at_ + opening);
        if (end == std::string_view::npos)
            throw ExpressionFault(at_, fmt::format("{} has no \"{}\" at its end", in_quotes(rest()), close));
        Token token{kind, std::string(text_.substr(at_ + opening, end - at_ - opening)), at_};
        at_ = end + 1;
        return token;
    }

    Token sign() {
        const auto found =
            std::ranges::find_if(kSigns, [&](std::string_view s) { return rest().starts_with(s); });
        const auto other =
            std::ranges::find_if(kElsewhere, [&](const auto& e) { return rest().starts_with(e.first); });
        const bool is_longer = other != kElsewhere.end() && found != kSigns.end() &&
                               std::string_view(other->first).size() > found->size();
        if (found != kSigns.end() && !is_longer) return take(Token::Kind::kSign, found->size());
        if (text_[at_] == ',') return take(Token::Kind::kSign, 1);
        const std::string_view bad = other != kElsewhere.end()
                                         ? std::string_view(other->first)
                                         : rest().substr(0, std::max<std::size_t>(1, utf8_length(rest())));
        throw ExpressionFault(at_, fmt::format("{} has no meaning in an expression", in_quotes(bad)),
                              other != kElsewhere.end() ? other->second : "");
    }

    std::string_view text_;
    std::size_t at_;
};

}  // namespace

std::vector<Token> tokens_of(std::string_view text, std::size_t begin) { return Lexer(text, begin).tokens(); }

}  // namespace keyline
