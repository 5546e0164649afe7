// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

// Rows of samples from a file's types to float and back.  Every function takes `n` samples, any alignment,
// and gives the same bits on every processor.  Source and destination must not overlap.

namespace keyline::simd {

// Exact: denormals, infinities and the payloads of NaNs (quiet or signalling) are kept.
void half_to_float(const uint16_t* from, float* to, std::size_t n);

// Rounds to the nearest half, ties to even.  A NaN keeps its sign and the upper ten bits of its payload (one
// whose upper bits are zero stays a NaN).  Returns how many finite values became infinite.
std::size_t float_to_half(const float* from, uint16_t* to, std::size_t n);

// Rounds to the nearest float, ties to even.  Returns how many values a float can't hold exactly.
std::size_t uint_to_float(const uint32_t* from, float* to, std::size_t n);

// Rounds to the nearest integer, ties to even, and clamps to what an unsigned holds; a NaN becomes 0. Returns
// how many values were NaN or had to be clamped.
std::size_t float_to_uint(const float* from, uint32_t* to, std::size_t n);

}  // namespace keyline::simd
