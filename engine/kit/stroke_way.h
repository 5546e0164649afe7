// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/kit/strokes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <vector>

// Strokes along their way: over the seam of a closed one, up to the ends of an open one.

namespace KEYLINE_API keyline {

// How a stroke goes at a vertex.  What it belongs to lies on the right of it, where y grows downwards: at
// (-y, x).
struct StrokeWay {
    double x = 0, y = 0;  // pixels
    double length = 0;    // of (x, y)
};

// From the vertex before to the one after.
inline StrokeWay way_at(const std::vector<StrokeVertex>& v, bool closed, std::size_t vertex) {
    const std::size_t last = v.size() - 1;
    const StrokeVertex& before = v[vertex > 0 ? vertex - 1 : closed ? last : 0];
    const StrokeVertex& after = v[vertex < last ? vertex + 1 : closed ? 0 : last];
    const double x = after.x - before.x, y = after.y - before.y;
    return {x, y, std::sqrt(x * x + y * y)};
}

inline StrokeWay way_at(const Stroke& s, std::size_t vertex) { return way_at(s.vertices, s.closed, vertex); }

// The mean of a value of each vertex and of `reach` on either side; where `pointed`, the nearer count the
// more.
inline double mean_along(const std::vector<double>& values, bool closed, std::size_t vertex,
                         std::ptrdiff_t reach, bool pointed) {
    const auto n = static_cast<std::ptrdiff_t>(values.size()), i = static_cast<std::ptrdiff_t>(vertex);
    double sum = 0, weights = 0;
    for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
        const std::ptrdiff_t j = closed ? ((i + k) % n + n) % n : i + k;
        if (j < 0 || j >= n) continue;
        const double weight = pointed ? static_cast<double>(reach + 1 - std::abs(k)) : 1;
        sum += weight * values[static_cast<std::size_t>(j)];
        weights += weight;
    }
    return sum / weights;
}

}  // namespace keyline
