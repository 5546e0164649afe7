// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/base/geometry.h"
#include "engine/kit/crossings.h"

#include <array>
#include <cstdint>
#include <vector>

// The borders between objects as a planar map: marching squares with many labels.  Four neighbouring centres
// are the corners of a cell; what crosses a cell's sides is joined inside it.  So lines have no gaps, every
// border comes once, and where three objects meet there is one point that three lines end at.

namespace KEYLINE_API keyline {

struct MapPoint {
    double x = 0, y = 0;
};

// From one junction, or the picture's rim, to another, or round; `right` is on the right hand of who walks
// along it.
struct Border {
    static constexpr int kRim = -1;

    uint32_t right = 0, left = 0;
    bool closed = false;
    std::array<int, 2> ends{kRim, kRim};  // junctions; not of a closed one
    std::vector<int> crossings;           // in order
};

struct BorderMap {
    Rect extent;  // where the picture ends
    std::vector<Crossing> crossings;
    std::vector<MapPoint> junctions;
    std::vector<Border> borders;

    // Where a crossing is: where both objects have the same share, or where `owner` alone has half.
    MapPoint at(int crossing, uint32_t owner = 0) const;
    // The side of a crossing on which an object is.
    const Crossing::Side& side(int crossing, uint32_t id) const;
};

// The crossings may be in any order.
BorderMap link_borders(std::vector<Crossing> crossings, const Rect& extent);

}  // namespace keyline
