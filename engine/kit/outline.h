// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/kit/strokes.h"

#include <cstdint>
#include <vector>

// What a stroke covers, as polygons: the discs of its width along its way, joined by their common tangents,
// with round ends and corners.

namespace keyline {

// In 256ths of a pixel.
struct FixedPoint {
    int64_t x = 0, y = 0;
    friend bool operator==(const FixedPoint&, const FixedPoint&) = default;
};

inline constexpr int kFixedOne = 256;

using Loop = std::vector<FixedPoint>;

// Closed loops.  A point is covered where they wind around it, in whichever direction; where the stroke runs
// over itself they wind more than once.  Arcs, and the way itself, are flattened to 0.01 pixels.
std::vector<Loop> outline_of(const Stroke& stroke);

}  // namespace keyline
