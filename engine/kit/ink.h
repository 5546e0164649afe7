// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/base/geometry.h"
#include "engine/kit/strokes.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

// What strokes leave on each row of a frame, as data: made once, and laid on any region.

namespace KEYLINE_API keyline {

// Pixels of one stroke in one row: `covers` of each, or, where they are covered alike, the one of all.
struct InkSpan {
    int x0 = 0, x1 = 0;
    uint32_t stroke = 0;
    bool even = false;
    std::size_t first = 0;  // of `covers`

    friend bool operator==(const InkSpan&, const InkSpan&) = default;
};

struct Ink {
    static constexpr const char* kind = "ink";
    using Colour = std::array<float, 3>;

    Rect window;
    std::vector<InkSpan> spans;     // by row, then in the order of the strokes, then from left to right
    std::vector<std::size_t> rows;  // where each row begins in `spans`, and where the last ends
    std::vector<float> covers;      // the stroke's opacity in them
    std::vector<Colour> colours;    // of each stroke

    std::span<const InkSpan> row(int y) const {
        const auto i = static_cast<std::size_t>(y - window.y0);
        return std::span(spans).subspan(rows[i], rows[i + 1] - rows[i]);
    }
    std::size_t bytes() const;
    friend bool operator==(const Ink&, const Ink&) = default;
};

// Inside `window`; a colour for each stroke.
Ink ink_of(const Strokes& strokes, const Rect& window, std::vector<Ink::Colour> colours);

}  // namespace keyline
