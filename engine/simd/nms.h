// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/simd/gradient.h"

namespace keyline::simd {

// Non-maximum suppression of one row that is neither the data window's first nor its last.
//
// With m the magnitude at the pixel, sx = −1 where dx < 0, else 1 (sy alike), and where |dx| ≥ |dy|, w =
// |dy|/|dx|:
//     A = m(−sx, 0) + w (m(−sx, −sy) − m(−sx, 0))        B = m(sx, 0) + w (m(sx, sy) − m(sx, 0))
// and elsewhere with x and y exchanged.  (Written so, and not as (1 − w) … + w …, two equal neighbours give
// exactly their value, and a plateau its tie.)  A pixel is kept when m > 0, A ≤ m and B < m: out is then dx,
// dy and m, else 0, 0 and 0.  A NaN among the numbers compared suppresses the pixel, and so does dx = dy = 0.
// The row's end pixels are suppressed where `margin` is 0.
void nms_row(const Rows3& magnitude, const float* dx, const float* dy, int n, Margin margin,
             const GradientRow& out);

}  // namespace keyline::simd
