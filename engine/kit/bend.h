// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/kit/borders.h"

#include <span>
#include <vector>

// How a line through points runs at each of them, though the points are off by a little.

namespace KEYLINE_API keyline {

struct Bend {
    double tx = 1, ty = 0;  // the direction, of length 1
    double curvature = 0;   // 1 / pixels; above 0 where it turns clockwise, as seen
};

// From the parabola that fits the points within `reach` pixels of the way best, the nearer the more; of a
// closed line, which goes on from its last point to its first, at most a quarter round.
std::vector<Bend> bends_of(std::span<const MapPoint> points, bool closed, double reach);

}  // namespace keyline
