// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/error.h"
#include "engine/json/json_tree.h"
#include "engine/json/json_writer.h"

#include <string>
#include <vector>

namespace keyline::lsp {

// As the protocol counts: lines from 0, and in a line units of UTF-16.
struct Position {
    int line = 0, character = 0;
};

// A text, and where its bytes stand.  A line ends at LF, CR LF or a lone CR.
class Text {
public:
    explicit Text(std::string text);

    const std::string& all() const { return text_; }
    Position position_of(std::size_t byte) const;
    std::size_t byte_of(Position position) const;
    std::size_t byte_of(const Place& place) const;  // whatever its file

    void replace(Position begin, Position end, const std::string& by);

    // A range of the protocol.
    void write_range(JsonWriter& json, Span span) const;

private:
    Span line(int number) const;  // without its end

    std::string text_;
    std::vector<std::size_t> lines_;  // where they begin
};

}  // namespace keyline::lsp
