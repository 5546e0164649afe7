// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/simd/threshold.h"

#include "engine/simd/rows.h"

// What follows foreach_target.h is compiled once for each target.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/simd/threshold.cpp"
#include <hwy/foreach_target.h>
#include "engine/simd/bits-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace keyline::simd::HWY_NAMESPACE {

void threshold(const float* in, int n, float low, float high, uint64_t* weak, uint64_t* strong) {
    const auto low_lanes = hn::Set(kFloat, low), high_lanes = hn::Set(kFloat, high);
    for_each_word(in, n, [&](const float* pixels, int word, uint64_t exist) HWY_ATTR {
        const auto above_low = [&](Floats v) HWY_ATTR { return hn::Gt(v, low_lanes); };
        const auto from_high = [&](Floats v) HWY_ATTR { return hn::Ge(v, high_lanes); };
        weak[word] = word_of(pixels, above_low) & exist;
        strong[word] = word_of(pixels, from_high) & weak[word];
    });
}

void expand(const uint64_t* bits, int n, float* out) {
    expand_bits(bits, n, hn::Set(kFloat, 1.0F), hn::Zero(kFloat), out);
}

}  // namespace keyline::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace keyline::simd {

HWY_EXPORT(threshold);
HWY_EXPORT(expand);

void threshold_row(const float* in, int n, float low, float high, uint64_t* weak, uint64_t* strong) {
    HWY_DYNAMIC_DISPATCH(threshold)(in, n, low, high, weak, strong);
}

void expand_row(const uint64_t* bits, int n, float* out) { HWY_DYNAMIC_DISPATCH(expand)(bits, n, out); }

}  // namespace keyline::simd
#endif  // HWY_ONCE
