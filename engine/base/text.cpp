// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/base/text.h"

#include <fmt/format.h>

namespace keyline {

namespace {

unsigned byte_at(std::string_view text, std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
}

bool is_continuation(unsigned byte) { return (byte & 0xC0U) == 0x80U; }

// Of one well-formed sequence.
unsigned code_point(std::string_view sequence) {
    if (sequence.size() == 1) return byte_at(sequence, 0);
    unsigned code = byte_at(sequence, 0) & (0x7FU >> sequence.size());
    for (std::size_t i = 1; i < sequence.size(); ++i) code = code << 6U | (byte_at(sequence, i) & 0x3FU);
    return code;
}

// Control characters, separators of lines and paragraphs, marks and overrides of the writing's direction.
bool acts_on_a_terminal(unsigned code) {
    return code < 0x20 || (code >= 0x7F && code < 0xA0) || code == 0x061C || code == 0x200E ||
           code == 0x200F || (code >= 0x2028 && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069);
}

std::string escape_of(unsigned code, Escapes escapes) {
    if (code == '\n') return "\\n";
    if (code == '\t') return "\\t";
    return code < 0x80 && escapes == Escapes::kShown ? fmt::format("\\x{:02x}", code)
                                                     : fmt::format("\\u{:04x}", code);
}

void append_escaped(std::string& out, std::string_view sequence, Escapes escapes) {
    const unsigned code = code_point(sequence);
    if (acts_on_a_terminal(code)) {
        out += escape_of(code, escapes);
    } else {
        if (escapes == Escapes::kJson && (code == '"' || code == '\\')) out += '\\';
        out += sequence;
    }
}

}  // namespace

std::size_t utf8_length(std::string_view text) {
    const unsigned lead = byte_at(text, 0), second = byte_at(text, 1);
    const bool third = is_continuation(byte_at(text, 2)), fourth = is_continuation(byte_at(text, 3));
    const auto second_in = [second](unsigned low, unsigned high) { return second >= low && second <= high; };
    if (text.empty()) return 0;
    if (lead < 0x80) return 1;
    if (lead >= 0xC2 && lead < 0xE0) return is_continuation(second) ? 2 : 0;
    // The bounds of the second byte leave out overlong forms, surrogates and what is beyond U+10FFFF.
    if (lead >= 0xE0 && lead < 0xF0)
        return second_in(lead == 0xE0 ? 0xA0 : 0x80, lead == 0xED ? 0x9F : 0xBF) && third ? 3 : 0;
    if (lead >= 0xF0 && lead < 0xF5)
        return second_in(lead == 0xF0 ? 0x90 : 0x80, lead == 0xF4 ? 0x8F : 0xBF) && third && fourth ? 4 : 0;
    return 0;
}

std::string escaped(std::string_view text, Escapes escapes) {
    std::string out;
    while (!text.empty()) {
        const std::size_t length = utf8_length(text);
        if (length > 0)
            append_escaped(out, text.substr(0, length), escapes);
        else if (escapes == Escapes::kJson)
            out += "\xef\xbf\xbd";
        else
            out += fmt::format("\\x{:02x}", byte_at(text, 0));
        text.remove_prefix(length > 0 ? length : 1);
    }
    return out;
}

std::string for_xml(std::string_view text) {
    std::string out;
    for (const char c : escaped(text)) switch (c) {
            case '&': out += "&amp;"; break;
            case '<': out += "&lt;"; break;
            case '>': out += "&gt;"; break;
            case '"': out += "&quot;"; break;
            default: out += c;
        }
    return out;
}

}  // namespace keyline
