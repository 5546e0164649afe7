// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/lsp/text.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace keyline::lsp {

namespace {

bool is_continuation(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

// Of the character that begins with this byte: what lies beyond 16 bits is a pair.
int units_of(char first) { return static_cast<unsigned char>(first) >= 0xF0U ? 2 : 1; }

std::size_t next_character(std::string_view text, std::size_t at) {
    for (++at; at < text.size() && is_continuation(text[at]);) ++at;
    return at;
}

void write_position(JsonWriter& json, Position p) {
    json.begin_object().field("line", p.line).field("character", p.character).end_object();
}

}  // namespace

Text::Text(std::string text) : text_(std::move(text)), lines_{0} {
    for (std::size_t i = 0; i < text_.size(); ++i) {
        const bool is_pair = text_[i] == '\r' && i + 1 < text_.size() && text_[i + 1] == '\n';
        if (text_[i] == '\n' || (text_[i] == '\r' && !is_pair)) lines_.push_back(i + 1);
    }
}

Span Text::line(int number) const {
    const auto i = static_cast<std::size_t>(std::clamp(number, 0, static_cast<int>(lines_.size()) - 1));
    std::size_t end = i + 1 < lines_.size() ? lines_[i + 1] : text_.size();
    while (end > lines_[i] && (text_[end - 1] == '\n' || text_[end - 1] == '\r')) --end;
    return {lines_[i], end};
}

Position Text::position_of(std::size_t byte) const {
    const auto after = std::ranges::upper_bound(lines_, byte);
    const auto line = static_cast<std::size_t>(after - lines_.begin()) - 1;
    Position out{static_cast<int>(line), 0};
    for (std::size_t at = lines_[line]; at < std::min(byte, text_.size()); at = next_character(text_, at))
        out.character += units_of(text_[at]);
    return out;
}

std::size_t Text::byte_of(Position position) const {
    if (position.line >= static_cast<int>(lines_.size())) return text_.size();
    const Span of = line(position.line);
    std::size_t at = of.begin;
    for (int units = position.character; units > 0 && at < of.end; at = next_character(text_, at))
        units -= units_of(text_[at]);
    return at;
}

std::size_t Text::byte_of(const Place& place) const {
    const Span of = line(place.line - 1);
    std::size_t at = of.begin;
    if (at == 0 && text_.starts_with("\xEF\xBB\xBF")) at = 3;
    for (int characters = place.column - 1; characters > 0 && at < of.end; --characters)
        at = next_character(text_, at);
    return at;
}

void Text::replace(Position begin, Position end, const std::string& by) {
    const std::size_t from = byte_of(begin), to = std::max(from, byte_of(end));
    *this = Text(text_.substr(0, from) + by + text_.substr(to));
}

void Text::write_range(JsonWriter& json, Span span) const {
    json.begin_object().key("start");
    write_position(json, position_of(span.begin));
    json.key("end");
    write_position(json, position_of(span.end));
    json.end_object();
}

}  // namespace keyline::lsp
