// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"

#include <cstdint>

// Rows of bits, 64 pixels a word: pixel i is bit i % 64 of word i / 64.

namespace KEYLINE_API keyline {
namespace simd {

constexpr int words_for(int pixels) { return (pixels + 63) / 64; }

// Writes words_for(n) words to each: weak where in > low, strong where in > low and in ≥ high.  NaN is
// neither; the bits behind the last pixel are 0.
void threshold_row(const float* in, int n, float low, float high, uint64_t* weak, uint64_t* strong);

// out[i] = 1 where the bit is set, else 0.
void expand_row(const uint64_t* bits, int n, float* out);

}  // namespace simd
}  // namespace keyline
