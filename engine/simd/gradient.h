// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/simd/rows.h"

#include <span>

namespace KEYLINE_API keyline {
namespace simd {

enum class GradientOperator {
    kCentral,  // [-1 0 1], not halved
    kSobel,    // [-1 0 1] ⊗ [1 2 1]ᵀ / 8
    kPrewitt,  // [-1 0 1] ⊗ [1 1 1]ᵀ / 6
    kScharr,   // [-1 0 1] ⊗ [3 10 3]ᵀ / 32
};

struct GradientRow {
    float *dx, *dy, *magnitude;
};

// One row of the gradient.  Reaches one pixel to each side; where `margin` is 0 the end pixel is repeated,
// which makes `central` a one-sided difference.  The rows over and under the image's are repeated by
// rows_around().
//
// Of one channel, in float:
//     central    dx = at[1] − at[-1]
//     others     dx = (c (above[1] − above[-1]) + c (below[1] − below[-1])) + s (at[1] − at[-1])
// with c the corner's and s the side's weight; dy is the transpose, y down; magnitude = √(dx² + dy²), which
// neither overflows nor underflows in between.
//
// Of several channels, in double: Di Zenzo's.  With J = Σ [dx², dx dy; dx dy, dy²] and λ its larger
// eigenvalue, magnitude = √λ, and (dx, dy) = magnitude × the unit eigenvector of λ with dx > 0, or dx = 0 and
// dy ≥ 0.  Where both eigenvalues are equal every direction is right and it is (1, 0).
void gradient_row(GradientOperator op, std::span<const Rows3> channels, int n, Margin margin,
                  const GradientRow& out);

}  // namespace simd
}  // namespace keyline
