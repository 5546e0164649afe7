// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"

#include <array>

// Point operations on rows of colour; rows.h says what is common to all kernels.

namespace KEYLINE_API keyline {
namespace simd {

struct RgbRows {
    const float *r, *g, *b;
};

// out = (r w[0] + g w[1]) + b w[2]
void weighted_rgb_row(const RgbRows& in, const std::array<float, 3>& weights, int n, float* out);

// out = 0 where in < 0, 1 where in > 1, else in; −0 and NaN stay.
void clamp_row(const float* in, int n, float* out);

// out = |in|^exponent with the sign of in, to 1e-7 of its value; exponent above 0.  ±0 and ±∞ stay.
void signed_power_row(const float* in, int n, double exponent, float* out);

// out = in × factor
void scale_row(const float* in, int n, float factor, float* out);

// How much of the foreground is taken, pixel by pixel.
struct Coverage {
    const float* alpha;  // the foreground's A; null: 1
    const float* mask;   // null: 1
    float mix;
};

// With k = mix, or mask × mix: out = fg k + bg (1 − alpha k).
void over_row(const float* fg, const Coverage& coverage, const float* bg, int n, float* out);

}  // namespace simd
}  // namespace keyline
