// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/simd/rows.h"

#include <array>

namespace KEYLINE_API keyline {
namespace simd {

// 1 / depth; 0 where that is 0 or less, which is infinitely far.
void nearness_row(const float* depth, int n, double* out);

struct PlaneStepRow {
    float *dx, *dy, *magnitude;
};

// What a pixel's neighbours differ by in nearness beyond what the surfaces on both sides go on with, as a
// share of the nearer, along x and along y.  `rows` are those from two above to two below, readable for two
// pixels to either side, too.  Along an axis that is not `known` it is 0.
void plane_step_row(const std::array<const double*, 5>& rows, int n, bool known_x, bool known_y,
                    const PlaneStepRow& out);

}  // namespace simd
}  // namespace keyline
