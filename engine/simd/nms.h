// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/simd/gradient.h"

namespace KEYLINE_API keyline {
namespace simd {

// Magnitudes that differ by no more than this part of them are equal: the two columns beside a symmetric step
// are equal in theory, and rounding must not choose between them.
inline constexpr float kEqual = 0x1p-18F;

// Non-maximum suppression of one row that is neither the picture's first nor its last.
//
// With m the magnitude at the pixel, sx = −1 where dx < 0, else 1 (sy alike), and where |dx| ≥ |dy|, w =
// |dy|/|dx|:
//     A = m(−sx, 0) + w (m(−sx, −sy) − m(−sx, 0))        B = m(sx, 0) + w (m(sx, sy) − m(sx, 0))
// and elsewhere with x and y exchanged.  A pixel is kept when m > 0, A ≤ m (1 + kEqual) and B < m (1 −
// kEqual): out is then dx, dy and m, else 0, 0 and 0.  So a plateau keeps its last pixel along the gradient.
// Where B is only equal, at most m (1 + kEqual), the pixel is kept too if the gradient there, interpolated as
// B is, points the other way: dx/m × dx_B + dy/m × dy_B < 0, as between the two sides of a line two pixels
// wide.
//
// A NaN among the numbers compared suppresses the pixel, and so does dx = dy = 0.  The row's end pixels are
// suppressed where `margin` is 0.
void nms_row(const Rows3& magnitude, const Rows3& dx, const Rows3& dy, int n, Margin margin,
             const GradientRow& out);

}  // namespace simd
}  // namespace keyline
