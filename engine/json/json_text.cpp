// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/json/json_text.h"

#include "engine/base/error.h"
#include "engine/base/text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <fmt/format.h>

namespace keyline {

namespace {

unsigned byte_at(std::string_view text, std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0;
}

bool is_continuation(unsigned byte) { return (byte & 0xC0U) == 0x80U; }

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

// What numbers, and the words that people write where JSON has none, are made of.
bool is_word_character(char c) { return is_letter(c) || is_digit(c) || c == '+' || c == '-' || c == '.'; }

std::string_view word_at(std::string_view text) {
    const auto end = std::find_if_not(text.begin(), text.end(), is_word_character);
    return text.substr(0, static_cast<std::size_t>(end - text.begin()));
}

// A word, a string up to its quote or its line's end, or one character.
std::string_view token_at(std::string_view text) {
    if (const std::string_view word = word_at(text); !word.empty()) return word;
    if (text.front() != '"' && text.front() != '\'') return text.substr(0, utf8_length(text));
    const std::array ends{text.front(), '\n', '\r', '\0'};
    const std::size_t end = text.find_first_of(ends.data(), 1);
    const bool closed = end != std::string_view::npos && text[end] == text.front();
    return text.substr(0, closed ? end + 1 : end);
}

JsonFault expected(const TextCursor& at, std::string_view what) {
    if (at.rest().starts_with("/*")) return {at, "the comment is not closed", "it ends with '*/'"};
    const std::string found = at.at_end() ? "the end of the file" : in_quotes(token_at(at.rest()));
    const bool script = at.peek() == '#';
    return {at, fmt::format("expected {}, found {}", what, found),
            script ? "comments are written as // or /* */" : ""};
}

std::optional<unsigned> hex4(std::string_view digits) {
    if (digits.size() < 4) return std::nullopt;
    unsigned code = 0;
    const char* end = digits.data() + 4;
    const auto [stop, error] = std::from_chars(digits.data(), end, code, 16);
    return stop == end ? std::optional(code) : std::nullopt;
}

// Length of the escape that `text` starts with; 0 where it is none that JSON knows.
std::size_t escape_length(std::string_view text) {
    const char kind = text.size() > 1 ? text[1] : '\0';
    if (kind != 'u') return std::string_view("\"\\/bfnrt").find(kind) == std::string_view::npos ? 0 : 2;
    const auto code = hex4(text.substr(2));
    if (!code || (*code >= 0xDC00 && *code < 0xE000)) return 0;
    if (*code < 0xD800 || *code >= 0xE000) return 6;
    if (text.substr(6, 2) != "\\u") return 0;
    const auto low = hex4(text.substr(8));
    return low && *low >= 0xDC00 && *low < 0xE000 ? 12 : 0;
}

JsonFault bad_escape(const TextCursor& at) {
    const std::string_view rest = at.rest();
    if (byte_at(rest, 1) == 'u') {
        const std::string_view digits = word_at(rest.substr(1));
        return {at, fmt::format("'\\{}' stands for no character", digits.substr(0, 5)),
                "'\\u' takes four hexadecimal digits, and surrogates come in pairs"};
    }
    return {at, fmt::format("{} is no escape", in_quotes(rest.substr(0, 1 + utf8_length(rest.substr(1))))),
            "a backslash itself is written as '\\\\'"};
}

JsonFault bad_control_character(const TextCursor& at) {
    const unsigned code = byte_at(at.rest(), 0);
    const std::string escape = code == '\t' ? "\\t" : fmt::format("\\u{:04x}", code);
    return {at, fmt::format("a string holds the control character U+{:04X}", code),
            fmt::format("write it as '{}'", escape)};
}

std::optional<JsonFault> fault_in_string(TextCursor at) {
    const TextCursor opening = at;
    at.advance();
    while (!at.at_end() && at.peek() != '"' && at.peek() != '\n' && at.peek() != '\r') {
        if (byte_at(at.rest(), 0) < 0x20) return bad_control_character(at);
        const std::size_t length = at.peek() == '\\' ? escape_length(at.rest()) : 1;
        if (length == 0) {
            TextCursor after = at;
            after.advance();
            if (after.at_end()) break;
            return bad_escape(at);
        }
        at.advance(length);
    }
    if (at.peek() == '"') return std::nullopt;
    return JsonFault{opening, fmt::format("the string {} is not closed", in_quotes(token_at(opening.rest()))),
                     "a string ends on its line, with '\"'"};
}

JsonFault fault_in_number(const TextCursor& at, std::string_view word) {
    return {at, fmt::format("{} is not a JSON number", in_quotes(word)),
            "numbers are written as 12, -0.5 or 1e-3"};
}

JsonFault single_quoted(const TextCursor& at) {
    std::string_view token = token_at(at.rest());
    const bool closed = token.size() > 1 && token.back() == '\'';
    token = token.substr(1, token.size() - (closed ? 2 : 1));
    return {at, fmt::format("{} stands in single quotes", in_quotes(token)), "JSON's are double"};
}

bool is_number_like(std::string_view word) {
    return is_digit(word.front()) || word.front() == '-' || word.front() == '+' || word.front() == '.';
}

JsonFault fault_in_word(const TextCursor& at, std::string_view word) {
    static constexpr std::array<std::string_view, 5> kNoNumbers{"NaN", "nan", "Infinity", "inf", "Inf"};
    if (is_number_like(word)) return fault_in_number(at, word);
    if (std::find(kNoNumbers.begin(), kNoNumbers.end(), word) != kNoNumbers.end())
        return {at, fmt::format("{} is not a JSON number", in_quotes(word)), "a number is finite"};
    std::string hint = did_you_mean(word, {"true", "false", "null"});
    if (hint.empty()) hint = "strings stand in double quotes";
    return {at, fmt::format("{} is not a JSON value", in_quotes(word)), hint};
}

JsonFault fault_in_value(const TextCursor& at) {
    const std::string_view word = word_at(at.rest());
    if (!word.empty()) return fault_in_word(at, word);
    if (at.peek() == '\'') return single_quoted(at);
    if (at.peek() == '"')
        if (const auto fault = fault_in_string(at)) return *fault;
    return expected(at, "a value");
}

JsonFault fault_in_key(const TextCursor& at) {
    if (is_letter(at.peek()))
        return {at, fmt::format("the key {} stands without quotes", in_quotes(word_at(at.rest()))),
                "keys stand in double quotes"};
    if (at.peek() == '\'') return single_quoted(at);
    if (at.peek() == '"')
        if (const auto fault = fault_in_string(at)) return *fault;
    return expected(at, "a key in double quotes");
}

// After a value in an object or array: the fault is in what stands instead of the comma, or behind it.
JsonFault fault_after_item(TextCursor at, bool object) {
    if (at.peek() != ',')
        return expected(at, object ? "',' or '}' after a value" : "',' or ']' after a value");
    const TextCursor comma = at;
    at.advance();
    at.skip_blanks();
    const char close = object ? '}' : ']';
    if (at.peek() == close) return {comma, fmt::format("there is a ',' too many before the '{}'", close), {}};
    JsonFault fault = object ? fault_in_key(at) : fault_in_value(at);
    if (object && is_digit(at.peek())) fault.hint = "a number has a point, as 0.5, and no comma";
    return fault;
}

JsonFault fault_after_key(TextCursor at) {
    if (at.peek() != ':') return expected(at, "':' after a key");
    at.advance();
    at.skip_blanks();
    return fault_in_value(at);
}

// "5px" is read as the number 5 and then something else: a word goes on where the token was taken to end.
std::optional<JsonFault> fault_in_torn_word(const TextCursor& token, const TextCursor& end) {
    if (end.at_end() || !is_word_character(end.peek()) || !is_word_character(token.peek()))
        return std::nullopt;
    return fault_in_word(token, word_at(token.rest()));
}

}  // namespace

TextCursor::TextCursor(std::string_view text) : text_(text) {
    if (text.starts_with("\xEF\xBB\xBF")) offset_ = 3;
}

void TextCursor::advance(std::size_t bytes) {
    for (const std::size_t end = std::min(offset_ + bytes, text_.size()); offset_ < end; ++offset_) {
        const char c = text_[offset_];
        const bool carriage_return_of_a_pair = c == '\r' && byte_at(text_, offset_ + 1) == '\n';
        if (c == '\n' || (c == '\r' && !carriage_return_of_a_pair)) {
            ++line_;
            column_ = 1;
        } else if (!is_continuation(byte_at(text_, offset_))) {
            ++column_;
        }
    }
}

void TextCursor::skip_blanks() {
    while (true) {
        const std::string_view left = rest();
        std::size_t length = std::min(left.find_first_not_of(" \t\r\n"), left.size());
        if (left.starts_with("//")) length = std::min(left.find_first_of("\r\n"), left.size());
        if (left.starts_with("/*")) {
            const std::size_t end = left.find("*/", 2);
            length = end == std::string_view::npos ? 0 : end + 2;
        }
        if (length == 0) return;
        advance(length);
    }
}

std::size_t number_length(std::string_view text) {
    std::size_t i = byte_at(text, 0) == '-' ? 1 : 0;
    const auto skip_digits = [&] { i = std::min(text.find_first_not_of("0123456789", i), text.size()); };
    if (byte_at(text, i) == '0')
        ++i;
    else
        skip_digits();
    if (byte_at(text, i) == '.') {
        ++i;
        skip_digits();
    }
    if (byte_at(text, i) == 'e' || byte_at(text, i) == 'E') {
        i += byte_at(text, i + 1) == '+' || byte_at(text, i + 1) == '-' ? 2 : 1;
        skip_digits();
    }
    return i;
}

std::optional<JsonFault> find_encoding_fault(std::string_view text) {
    TextCursor at(text);
    while (!at.at_end()) {
        const std::size_t length = utf8_length(at.rest());
        if (length == 0)
            return JsonFault{at, fmt::format("the byte 0x{:02x} is not UTF-8", byte_at(at.rest(), 0)),
                             "save the file as UTF-8 text"};
        if (at.peek() == '\0')
            return JsonFault{at, "a NUL byte", "this is no text; 'keyline info' tells what is in an image"};
        at.advance(length);
    }
    return std::nullopt;
}

JsonFault explain_json_fault(const TextCursor& token, const TextCursor& end, JsonNext next) {
    if (const auto fault = fault_in_torn_word(token, end)) return *fault;
    TextCursor at = end;
    at.skip_blanks();
    switch (next) {
        case JsonNext::kValue: return fault_in_value(at);
        case JsonNext::kKeyOrEnd: return fault_in_key(at);
        case JsonNext::kColon: return fault_after_key(at);
        case JsonNext::kCommaOrBrace: return fault_after_item(at, true);
        case JsonNext::kCommaOrBracket: return fault_after_item(at, false);
        case JsonNext::kNothing: break;
    }
    return expected(at, "nothing more");
}

}  // namespace keyline
