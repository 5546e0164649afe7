// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace keyline::cli {

// How a terminal shows pictures.
enum class TerminalKind { kKitty, kIterm, kSixel, kBlocks };

// Of a word, or of the environment where it is empty.  Throws Failure (kGraph) for another word.
TerminalKind terminal_kind(const std::string& word);

struct TerminalSize {
    int columns = 80, rows = 24;
};
TerminalSize terminal_size();

// 8 bits of R, G and B, row by row.
struct Bitmap {
    int width = 0, height = 0;
    std::vector<uint8_t> rgb;
};

// The bytes of a PNG file, in the protocols of kitty and of iTerm2.
std::string kitty_text(std::string_view png);
std::string iterm_text(std::string_view png);

// Pixels in colours of six steps a channel, as DEC's terminals take them.
std::string sixel_text(const Bitmap& bitmap);

// Two pixels a character, one above the other.
std::string blocks_text(const Bitmap& bitmap);

}  // namespace keyline::cli
