// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/base/image.h"

#include <limits>

namespace KEYLINE_API keyline {

// Of two NaN operands arithmetic keeps the first, and which that is the compiler decides: a computed pixel
// has one NaN only.
inline float with_one_nan(float v) { return v == v ? v : std::numeric_limits<float>::quiet_NaN(); }

// The smaller and the larger of two; NaN is passed over.
inline float smaller(float a, float b) { return a < b || b != b ? a : b; }
inline float larger(float a, float b) { return a > b || b != b ? a : b; }

// out = f(a, b, …), pixel by pixel, over the rectangle of `out`, which the inputs cover and do not overlap.
template <class F, class... Ins>
void for_each_pixel(const MutView& out, F&& f, const Ins&... in) {
    const int n = out.rect.width();
    for (int y = out.rect.y0; y < out.rect.y1; ++y)
        [&](float* __restrict to, const auto* __restrict... from) {
            for (int i = 0; i < n; ++i) to[i] = with_one_nan(f(from[i]...));
        }(out.row(y), in.at(out.rect.x0, y)...);
}

}  // namespace keyline
