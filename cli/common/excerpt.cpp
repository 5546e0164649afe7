// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/common/excerpt.h"

#include "engine/base/text.h"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <string_view>
#include <unistd.h>

namespace keyline::cli {

namespace {

constexpr std::string_view kError = "\x1b[1;31m", kWarning = "\x1b[1;35m", kPale = "\x1b[2m",
                           kPlain = "\x1b[0m";

// Of a long line, what is before the place and behind it.
constexpr std::size_t kMostBefore = 90, kMostBehind = 40;

std::string coloured(std::string_view text, std::string_view colour, const MessageStyle& style) {
    return style.colours ? fmt::format("{}{}{}", colour, text, kPlain) : std::string(text);
}

std::size_t characters(std::string_view text) {
    return static_cast<std::size_t>(
        std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

// The byte where a character begins, from 0; the end of the text where there are fewer.
std::size_t byte_of(std::string_view text, std::size_t character) {
    std::size_t at = 0;
    for (; character > 0 && at < text.size(); --character)
        at += std::max<std::size_t>(1, utf8_length(text.substr(at)));
    return std::min(at, text.size());
}

// A string, a word or one character.
std::size_t token_length(std::string_view text) {
    if (text.starts_with('"')) {
        std::size_t end = 1;
        while (end < text.size() && text[end] != '"') end += text[end] == '\\' ? 2 : 1;
        return std::min(end + 1, text.size());
    }
    const std::size_t end = std::min(text.find_first_of(" \t,:{}[]\""), text.size());
    return std::max<std::size_t>(end, std::min<std::size_t>(1, text.size()));
}

// "" where there is none: a line that is gone, or an option.
std::string line_at(const Place& place) {
    std::ifstream in(place.file, std::ios::binary);
    std::string line;
    for (int i = 0; i < place.line; ++i)
        if (!std::getline(in, line)) return "";
    if (line.ends_with('\r')) line.pop_back();
    if (place.line == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);
    return line;
}

std::string excerpt(const Place& place, std::string_view colour, const MessageStyle& style) {
    const std::string line = place.line > 0 ? line_at(place) : "";
    if (line.empty() || place.column < 1) return "";
    const std::string_view text = line;
    const auto column = static_cast<std::size_t>(place.column - 1);
    const std::size_t first = column > kMostBefore ? column - kMostBefore : 0;
    const std::size_t at = byte_of(text, column), begin = byte_of(text, first);
    const std::string token = escaped(text.substr(at, token_length(text.substr(at))));
    const std::string before = (first > 0 ? "…" : "") + escaped(text.substr(begin, at - begin));
    std::string behind = escaped(text.substr(at)).substr(token.size());
    if (characters(behind) > kMostBehind) behind = behind.substr(0, byte_of(behind, kMostBehind)) + "…";
    const std::string number = std::to_string(place.line), margin(number.size(), ' ');
    const std::string mark = "^" + std::string(std::max<std::size_t>(characters(token), 1) - 1, '~');
    return fmt::format("\n{}{}{}{}\n{}{}{}", coloured(fmt::format(" {} | ", number), kPale, style), before,
                       token, behind, coloured(fmt::format(" {} | ", margin), kPale, style),
                       std::string(characters(before), ' '), coloured(mark, colour, style));
}

std::string styled(std::string line, const Error& error, std::string_view label, std::string_view colour,
                   const MessageStyle& style) {
    const std::string place = error.place.file.empty() ? "" : escaped(error.place.text() + ": ");
    if (style.colours && std::string_view(line).substr(place.size()).starts_with(label))
        line.replace(place.size(), label.size(), coloured(label, colour, style));
    if (!style.excerpts) return line;
    if (error.code != Code::kNone)
        line += coloured(fmt::format(" [{}]", code_name(error.code)), kPale, style);
    return line + excerpt(error.place, colour, style);
}

}  // namespace

MessageStyle message_style() {
    const auto value_of = [](const char* name) {
        const char* value = std::getenv(name);
        return std::string_view(value ? value : "");
    };
    const bool is_terminal = isatty(STDERR_FILENO) != 0;
    const std::string_view terminal = value_of("TERM");
    const bool has_colours = !terminal.empty() && terminal != "dumb";
    return {is_terminal, is_terminal && has_colours && value_of("NO_COLOR").empty()};
}

std::string styled_error(const Error& error, const MessageStyle& style) {
    return styled(error.text(), error, "error:", kError, style);
}

std::string styled_warning(const Error& warning, const MessageStyle& style) {
    return styled(warning.warning_text(), warning, "warning:", kWarning, style);
}

}  // namespace keyline::cli
