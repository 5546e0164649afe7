// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/kit/line_points.h"

#include <cstddef>
#include <vector>

// Points that belong to one line, in order.

namespace KEYLINE_API keyline {

struct PointChain {
    bool closed = false;
    std::vector<LinePoint> points;
};

// Two points hang together if they lie within 2 pixels, in each other's way, their ways turn by no more than
// 50 degrees, they are of one object, and neither has a nearer one there; where they are `directed`, the ways
// of both run on in one direction.  Chains that reach `high` somewhere are kept.  The points may be in any
// order.
std::vector<PointChain> link_points(std::vector<LinePoint> points, bool directed, double high);

// Of each point the mean strength of itself and of so many points on either side.
std::vector<double> strengths_along(const PointChain& chain, std::ptrdiff_t around);

}  // namespace keyline
