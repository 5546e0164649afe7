// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/kit/strokes.h"

#include <cmath>
#include <cstddef>
#include <vector>

namespace keyline {

// How a stroke goes at a vertex.  What it belongs to lies on the right of it, where y grows downwards: at
// (-y, x).
struct StrokeWay {
    double x = 0, y = 0;  // pixels
    double length = 0;    // of (x, y)
};

// From the vertex before to the one after; over the seam of a closed stroke, and from an end of an open one.
inline StrokeWay way_at(const Stroke& s, std::size_t vertex) {
    const std::vector<StrokeVertex>& v = s.vertices;
    const std::size_t last = v.size() - 1;
    const StrokeVertex& before = v[vertex > 0 ? vertex - 1 : s.closed ? last : 0];
    const StrokeVertex& after = v[vertex < last ? vertex + 1 : s.closed ? 0 : last];
    const double x = after.x - before.x, y = after.y - before.y;
    return {x, y, std::sqrt(x * x + y * y)};
}

}  // namespace keyline
