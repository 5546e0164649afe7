// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/simd/threshold.h"

#include "engine/simd/rows.h"

#include <cstring>

// What follows foreach_target.h is compiled once for each target.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/simd/threshold.cpp"
#include <hwy/foreach_target.h>
#include "engine/simd/rows-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace keyline::simd::HWY_NAMESPACE {

constexpr int kWord = 64;

HWY_INLINE uint64_t bits_of(hn::Mask<FloatTag> mask) {
    uint8_t bytes[8] = {};
    hn::StoreMaskBits(kFloat, mask, bytes);
    uint64_t bits;
    std::memcpy(&bits, bytes, sizeof bits);
    return bits;
}

void threshold(const float* in, int n, float low, float high, uint64_t* weak, uint64_t* strong) {
    const auto low_lanes = hn::Set(kFloat, low), high_lanes = hn::Set(kFloat, high);
    const auto word = [&](const float* pixels, uint64_t& weak_word, uint64_t& strong_word) HWY_ATTR {
        uint64_t weak_bits = 0, strong_bits = 0;
        for (int i = 0; i < kWord; i += kLanes) {
            const auto v = hn::LoadU(kFloat, pixels + i);
            const auto above_low = hn::Gt(v, low_lanes);
            weak_bits |= bits_of(above_low) << i;
            strong_bits |= bits_of(hn::And(above_low, hn::Ge(v, high_lanes))) << i;
        }
        weak_word = weak_bits;
        strong_word = strong_bits;
    };
    int i = 0;
    for (; i + kWord <= n; i += kWord) word(in + i, *weak++, *strong++);
    if (i == n) return;
    float rest[kWord];
    for (int k = 0; k < kWord; ++k) rest[k] = i + k < n ? in[i + k] : std::numeric_limits<float>::quiet_NaN();
    word(rest, *weak, *strong);
}

HWY_INLINE void expand_word(uint64_t bits, float* out) {
    const auto one = hn::Set(kFloat, 1.0F);
    for (int i = 0; i < kWord; i += kLanes) {
        const uint64_t from_i = bits >> i;
        uint8_t bytes[8];
        std::memcpy(bytes, &from_i, sizeof bytes);
        hn::StoreU(hn::IfThenElseZero(hn::LoadMaskBits(kFloat, bytes), one), kFloat, out + i);
    }
}

void expand(const uint64_t* bits, int n, float* out) {
    int i = 0;
    for (; i + kWord <= n; i += kWord) expand_word(*bits++, out + i);
    if (i == n) return;
    float rest[kWord];
    expand_word(*bits, rest);
    std::memcpy(out + i, rest, static_cast<size_t>(n - i) * sizeof(float));
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
