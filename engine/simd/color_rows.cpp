// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/simd/color_rows.h"

#include "engine/simd/rows.h"

// What follows foreach_target.h is compiled once for each target.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/simd/color_rows.cpp"
#include <hwy/foreach_target.h>
#include "engine/simd/elementary-inl.h"
#include "engine/simd/rows-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace keyline::simd::HWY_NAMESPACE {

void weighted_rgb(const RgbRows& in, const std::array<float, 3>& weights, int n, float* out) {
    const auto wr = hn::Set(kFloat, weights[0]), wg = hn::Set(kFloat, weights[1]);
    const auto wb = hn::Set(kFloat, weights[2]);
    for_each_vector(kFloat, n, [&](auto memory, int i) HWY_ATTR {
        const auto r = memory.load(kFloat, in.r, i), g = memory.load(kFloat, in.g, i);
        const auto b = memory.load(kFloat, in.b, i);
        const auto sum = hn::Add(hn::Add(hn::Mul(r, wr), hn::Mul(g, wg)), hn::Mul(b, wb));
        memory.store(with_one_nan(sum), kFloat, out, i);
    });
}

void clamp_unit(const float* in, int n, float* out) {
    const auto zero = hn::Zero(kFloat), one = hn::Set(kFloat, 1.0F);
    for_each_vector(kFloat, n, [&](auto memory, int i) HWY_ATTR {
        const auto v = memory.load(kFloat, in, i);
        const auto from_zero = hn::IfThenElse(hn::Lt(v, zero), zero, v);
        memory.store(with_one_nan(hn::IfThenElse(hn::Gt(v, one), one, from_zero)), kFloat, out, i);
    });
}

void signed_power(const float* in, int n, double exponent, float* out) {
    for_each_vector(kFewFloats, n, [&](auto memory, int i) HWY_ATTR {
        const auto v = hn::PromoteTo(kDouble, memory.load(kFewFloats, in, i));
        const auto power = hn::CopySignToAbs(pow(kDouble, hn::Abs(v), exponent), v);
        memory.store(rounded(power), kFewFloats, out, i);
    });
}

void scale(const float* in, int n, float factor, float* out) {
    const auto factors = hn::Set(kFloat, factor);
    for_each_vector(kFloat, n, [&](auto memory, int i) HWY_ATTR {
        memory.store(with_one_nan(hn::Mul(memory.load(kFloat, in, i), factors)), kFloat, out, i);
    });
}

void over(const float* fg, const Coverage& coverage, const float* bg, int n, float* out) {
    const auto one = hn::Set(kFloat, 1.0F), mix = hn::Set(kFloat, coverage.mix);
    for_each_vector(kFloat, n, [&](auto memory, int i) HWY_ATTR {
        const auto k = coverage.mask != nullptr ? hn::Mul(memory.load(kFloat, coverage.mask, i), mix) : mix;
        const auto alpha = coverage.alpha != nullptr ? memory.load(kFloat, coverage.alpha, i) : one;
        const auto front = hn::Mul(memory.load(kFloat, fg, i), k);
        const auto behind = hn::Mul(memory.load(kFloat, bg, i), hn::Sub(one, hn::Mul(alpha, k)));
        memory.store(with_one_nan(hn::Add(front, behind)), kFloat, out, i);
    });
}

}  // namespace keyline::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace keyline::simd {

HWY_EXPORT(weighted_rgb);
HWY_EXPORT(clamp_unit);
HWY_EXPORT(signed_power);
HWY_EXPORT(scale);
HWY_EXPORT(over);

void weighted_rgb_row(const RgbRows& in, const std::array<float, 3>& weights, int n, float* out) {
    HWY_DYNAMIC_DISPATCH(weighted_rgb)(in, weights, n, out);
}

void clamp_row(const float* in, int n, float* out) { HWY_DYNAMIC_DISPATCH(clamp_unit)(in, n, out); }

void signed_power_row(const float* in, int n, double exponent, float* out) {
    HWY_DYNAMIC_DISPATCH(signed_power)(in, n, exponent, out);
}

void scale_row(const float* in, int n, float factor, float* out) {
    HWY_DYNAMIC_DISPATCH(scale)(in, n, factor, out);
}

void over_row(const float* fg, const Coverage& coverage, const float* bg, int n, float* out) {
    HWY_DYNAMIC_DISPATCH(over)(fg, coverage, bg, n, out);
}

}  // namespace keyline::simd
#endif  // HWY_ONCE
