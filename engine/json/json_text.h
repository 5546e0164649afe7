// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

// What graph_json needs beside the parser: where a token stands, and in plain words what is wrong with text
// that the parser refused.

namespace keyline {

// Walks forward through UTF-8 text, counting lines and, within a line, code points.
class TextCursor {
public:
    explicit TextCursor(std::string_view text);  // past a byte order mark, where there is one

    bool at_end() const { return offset_ == text_.size(); }
    char peek() const { return at_end() ? '\0' : text_[offset_]; }
    std::string_view rest() const { return text_.substr(offset_); }
    std::size_t offset() const { return offset_; }
    int line() const { return line_; }      // from 1
    int column() const { return column_; }  // from 1

    void advance(std::size_t bytes = 1);

    // Past white space and comments; stops in front of a comment that does not end.
    void skip_blanks();

private:
    std::string_view text_;
    std::size_t offset_ = 0;
    int line_ = 1, column_ = 1;
};

// Length of the number that `text`, in which the parser found one, starts with.
std::size_t number_length(std::string_view text);

struct JsonFault {
    TextCursor at;
    std::string what;
    std::string hint;
};

// The first byte that is not text: invalid UTF-8, or NUL.
std::optional<JsonFault> find_encoding_fault(std::string_view text);

// What the grammar allows next.
enum class JsonNext {
    kValue,           // at the start, and after '['
    kKeyOrEnd,        // after '{'
    kColon,           // after a key
    kCommaOrBrace,    // after a value in an object
    kCommaOrBracket,  // after a value in an array
    kNothing,         // after the whole value
};

// Says what is wrong in text that a parser refused, being in the state `next` after the last token that it
// accepted.  `token` is where that token starts, `end` where it ends.
JsonFault explain_json_fault(const TextCursor& token, const TextCursor& end, JsonNext next);

}  // namespace keyline
