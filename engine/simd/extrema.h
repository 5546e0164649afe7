// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/base/image.h"

#include <cstddef>
#include <cstdint>
#include <span>

// The largest or smallest value within a shape around each pixel: dilation and erosion.
//
// A shape is given by its half-widths: half_widths[d] = w says that on the rows d above and d below the pixel
// the columns −w … w belong to it.  half_widths[0] is the largest.
//
// Pixels outside the data window take no part.  NaN takes no part either; where the shape holds nothing else
// the result is 0.  −0 is below +0, so that the result does not depend on the order of comparisons.  `in`
// covers out.rect grown by the shape, clipped to the data window.

namespace KEYLINE_API keyline {
namespace simd {

enum class Extremum { kMaximum, kMinimum };

using HalfWidths = std::span<const int>;

inline bool is_box(HalfWidths shape) { return shape.front() == shape.back(); }

// Any shape: time per pixel grows with its height.
std::size_t shape_workspace(const Rect& out, HalfWidths shape);
void shape_extremum(const View& in, const MutView& out, HalfWidths shape, Extremum which,
                    std::span<int32_t> workspace);

// A rectangle, of a row's width and shape.size() rows to each side: time per pixel grows with the logarithm
// of its width.
std::size_t box_workspace(const Rect& out, HalfWidths shape);
void box_extremum(const View& in, const MutView& out, HalfWidths shape, Extremum which,
                  std::span<int32_t> workspace);

// Any shape over a picture of two values, as lines are: with bits, many times faster.  Returns false, with
// `out` as it was, where `in` has a third value.
std::size_t mask_workspace(const View& in, const Rect& out, HalfWidths shape);
bool mask_extremum(const View& in, const MutView& out, HalfWidths shape, Extremum which,
                   std::span<uint64_t> workspace);

// The fastest of the three; all give the same bits.  `scratch.take<T>(n)` gives a span of n T.
template <class Scratch>
void extremum(const View& in, const MutView& out, HalfWidths shape, Extremum which, Scratch& scratch) {
    if (is_box(shape))
        return box_extremum(in, out, shape, which,
                            scratch.template take<int32_t>(box_workspace(out.rect, shape)));
    const auto words = scratch.template take<uint64_t>(mask_workspace(in, out.rect, shape));
    if (mask_extremum(in, out, shape, which, words)) return;
    shape_extremum(in, out, shape, which, scratch.template take<int32_t>(shape_workspace(out.rect, shape)));
}

}  // namespace simd
}  // namespace keyline
