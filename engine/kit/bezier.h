// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"

#include <array>
#include <vector>

// Few cubic curves in place of many points, for programs in which people draw on.

namespace KEYLINE_API keyline {

struct CurvePoint {
    double x = 0, y = 0;
};

// From the end of the one before: two handles, and where it ends.
using Bezier = std::array<CurvePoint, 3>;

// Curves that begin at the first point and leave no point by more than `tolerance`.  They go on smoothly into
// each other but at corners.  Of a closed line, whose last point goes on to the first, the last ends there.
std::vector<Bezier> fit_beziers(std::vector<CurvePoint> points, bool closed, double tolerance);

}  // namespace keyline
