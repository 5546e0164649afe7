// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/geometry.h"
#include "engine/kit/outline.h"

#include <cstdint>
#include <vector>

// How much of each pixel closed loops cover: exactly, to 256ths of a pixel in the places of the loops.  All
// sums are of integers, so that they are the same in any order.

namespace keyline {

// Pixels of one row.
struct CoverageSpan {
    int y = 0, x0 = 0, x1 = 0;
    std::size_t first = 0;  // of `covers`, where its pixels stand; kWhole where all are covered whole

    static constexpr std::size_t kWhole = SIZE_MAX;
};

struct Coverage {
    std::vector<CoverageSpan> spans;  // from top to bottom and left to right
    std::vector<float> covers;
};

// Inside `window`.
Coverage coverage_of(const std::vector<Loop>& loops, const Rect& window);

}  // namespace keyline
