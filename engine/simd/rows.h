// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/base/image.h"

#include <algorithm>

// What the row kernels of this folder share.
//
// A kernel computes one row of n ≥ 0 pixels.  `in` points to the pixel under out[0]; rows need no alignment;
// the output may not overlap an input.  Each pixel's value is the same operations in the same order whatever
// n, the pixel's place in the row, the instruction set or the thread (HOUSE: "Rules that make results
// independent of the schedule").  NaN and infinities follow IEEE arithmetic unless the kernel says otherwise.

namespace KEYLINE_API keyline {
namespace simd {

// Of floats in the widest vector that there is a body for.
constexpr std::size_t kMostLanes = 16;

// How many pixels beyond the first and the last can be read, in x or in y.  Fewer than a kernel's reach says
// that the data window ends there, and nothing else: a View covers a node's whole halo, clipped to the
// window.
struct Margin {
    int before = 0, after = 0;
};

inline Margin margin_x(const View& in, const Rect& out) { return {out.x0 - in.rect.x0, in.rect.x1 - out.x1}; }

inline Margin margin_y(const View& in, int y) { return {y - in.rect.y0, in.rect.y1 - 1 - y}; }

// A row with the rows over and under it.
struct Rows3 {
    const float *above, *at, *below;
};

// The rows around y from x0 on.  Over the first row of the data window stands the first again, and under the
// last the last.
inline Rows3 rows_around(const View& in, int x0, int y) {
    return {in.at(x0, std::max(y - 1, in.rect.y0)), in.at(x0, y), in.at(x0, std::min(y + 1, in.rect.y1 - 1))};
}

}  // namespace simd
}  // namespace keyline
