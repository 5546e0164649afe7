// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/simd/extrema.h"

#include <algorithm>
#include <bit>

// Where the extremum kernels keep things in their workspaces.  Rows are padded so that whole vectors of any
// instruction set may be read and written past their ends.

namespace keyline::simd {

constexpr int padded(int n) { return (n + 31) / 16 * 16; }

// For words of bits: up to whole vectors, but not beyond.
constexpr int whole_vectors(int words) { return (words + 7) / 8 * 8; }

// How many windows of 1, 2, 4, … pixels are no longer than `length`.
constexpr int window_levels(int length) {
    return static_cast<int>(std::bit_width(static_cast<unsigned>(length)));
}

// rows + 1 rows as wide as the output, then two lines.
struct BoxLayout {
    BoxLayout(const Rect& out, HalfWidths shape)
        : reach_x(shape[0]),
          reach_y(static_cast<int>(shape.size()) - 1),
          rows(out.height() + 2 * reach_y),
          pitch(padded(out.width())),
          line(padded(out.width() + 2 * reach_x)) {}

    std::size_t size() const {
        return static_cast<std::size_t>(rows + 1) * static_cast<std::size_t>(pitch) +
               2 * static_cast<std::size_t>(line);
    }

    int reach_x, reach_y;
    int rows;   // that a column of the output looks at
    int pitch;  // of a row as wide as the output
    int line;   // of one as wide as what it looks at
};

// The output is computed in strips, narrow enough that what is accumulated stays in the first-level cache:
// a row of the strip for each row of the output, then a line for each level.
struct ShapeLayout {
    ShapeLayout(const Rect& out, HalfWidths half_widths)
        : shape(half_widths),
          reach_x(shape[0]),
          reach_y(static_cast<int>(shape.size()) - 1),
          strip(std::min(out.width(), std::max(64, reach_x))),
          height(out.height()),
          pitch(padded(strip)),
          line(padded(pitch + 2 * reach_x)),
          levels(window_levels(2 * reach_x + 1)) {}

    std::size_t size() const {
        return static_cast<std::size_t>(height) * static_cast<std::size_t>(pitch) +
               static_cast<std::size_t>(levels) * static_cast<std::size_t>(line);
    }

    HalfWidths shape;
    int reach_x, reach_y;
    int strip, height;
    int pitch;  // of a row of the strip
    int line;   // of what it looks at
    int levels;
};

// Bits: a row of `segment` words for each row of the input that is looked at, then a line for each level,
// then a row of `pitch` words for each row of the output.  In a line, the input's bits begin at word `lead`;
// around them are zeros as far as the shape and a vector reach.
struct MaskLayout {
    MaskLayout(const View& in, const Rect& out, HalfWidths half_widths)
        : shape(half_widths),
          reach_y(static_cast<int>(shape.size()) - 1),
          looked_at(intersect(in.rect, grow(out, {shape[0], reach_y}))),
          segment((looked_at.width() + 63) / 64),
          lead(shape[0] / 64 + 1),
          used(whole_vectors(lead + segment)),
          line(used + padded(out.width() / 64 + 3 * lead)),
          levels(window_levels(2 * shape[0] + 1)),
          pitch(whole_vectors((out.width() + 63) / 64)),
          height(out.height()) {}

    std::size_t input_words() const {
        return static_cast<std::size_t>(looked_at.height()) * static_cast<std::size_t>(segment);
    }
    std::size_t line_words() const {
        return static_cast<std::size_t>(levels) * static_cast<std::size_t>(line);
    }
    std::size_t output_words() const {
        return static_cast<std::size_t>(height) * static_cast<std::size_t>(pitch);
    }
    std::size_t size() const { return input_words() + line_words() + output_words(); }

    HalfWidths shape;
    int reach_y;
    Rect looked_at;  // of the input
    int segment, lead;
    int used, line;  // words of a line that may be other than 0, and all
    int levels;
    int pitch, height;
};

}  // namespace keyline::simd
