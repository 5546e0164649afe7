// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/simd/half.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/simd/half.cpp"
#include <cstring>
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

// Highway's own float16 conversions are wrong below AVX2 (1.0.3), and F16C quiets signalling NaNs; integer
// arithmetic has one answer everywhere.

HWY_BEFORE_NAMESPACE();
namespace keyline::simd::HWY_NAMESPACE {  // NOLINT(modernize-concat-nested-namespaces)

namespace hn = hwy::HWY_NAMESPACE;

using F32 = hn::ScalableTag<float>;
using I32 = hn::RebindToSigned<F32>;
using U32 = hn::RebindToUnsigned<F32>;
using U16 = hn::Rebind<uint16_t, F32>;
using VF = hn::Vec<F32>;
using VI = hn::Vec<I32>;
using VU = hn::Vec<U32>;

constexpr I32 di;
constexpr F32 df;
constexpr U32 du;

// Runs `step(in, out)` on whole vectors; the last, shorter one goes through padded copies, so that every
// sample is treated by the same code.  `step` returns how many lanes to count.  The padding is zeros, which
// no step counts.
template <class From, class To, class Step>
std::size_t for_each_vector(const From* HWY_RESTRICT from, To* HWY_RESTRICT to, std::size_t n, Step step) {
    const std::size_t lanes = hn::Lanes(df);
    std::size_t counted = 0;
    std::size_t i = 0;
    for (; i + lanes <= n; i += lanes) counted += step(from + i, to + i);
    if (i == n) return counted;
    HWY_ALIGN From padded_from[hn::MaxLanes(df)] = {};
    HWY_ALIGN To padded_to[hn::MaxLanes(df)];
    std::memcpy(padded_from, from + i, (n - i) * sizeof(From));
    counted += step(padded_from, padded_to);
    std::memcpy(to + i, padded_to, (n - i) * sizeof(To));
    return counted;
}

VF widen(VI half) {
    const VI sign = hn::ShiftLeft<16>(hn::And(half, hn::Set(di, 0x8000)));
    const VI magnitude = hn::And(half, hn::Set(di, 0x7FFF));
    const VI shifted = hn::ShiftLeft<13>(magnitude);
    const VI normal = hn::Add(shifted, hn::Set(di, (127 - 15) << 23));
    const VI special = hn::Add(shifted, hn::Set(di, (255 - 31) << 23));
    // A denormal is its significand times 2^-24, both exact as floats.
    const VI denormal = hn::BitCast(di, hn::Mul(hn::ConvertTo(df, magnitude), hn::Set(df, 0x1p-24F)));
    const VI finite = hn::IfThenElse(hn::Lt(magnitude, hn::Set(di, 0x0400)), denormal, normal);
    const VI bits = hn::IfThenElse(hn::Gt(magnitude, hn::Set(di, 0x7BFF)), special, finite);
    return hn::BitCast(df, hn::Or(bits, sign));
}

void HalfToFloat(const uint16_t* from, float* to, std::size_t n) {
    for_each_vector(from, to, n, [](const uint16_t* in, float* out) HWY_ATTR {
        hn::StoreU(widen(hn::PromoteTo(di, hn::LoadU(U16(), in))), df, out);
        return std::size_t{0};
    });
}

struct Narrowed {
    VI half;
    hn::Mask<I32> overflowed;
};

Narrowed narrow(VI bits) {
    const VI infinity = hn::Set(di, 0x7F800000);
    const VI sign = hn::And(hn::ShiftRight<16>(bits), hn::Set(di, 0x8000));
    const VI magnitude = hn::And(bits, hn::Set(di, 0x7FFFFFFF));

    // Half an ulp less one, and one more where the kept part is odd: a tie goes to even, and a carry runs
    // into the exponent as it should, up to infinity.
    const VI odd = hn::And(hn::ShiftRight<13>(magnitude), hn::Set(di, 1));
    const VI rounded = hn::Add(hn::Add(magnitude, hn::Set(di, 0x0FFF)), odd);
    const VI normal = hn::ShiftRight<13>(hn::Sub(rounded, hn::Set(di, (127 - 15) << 23)));

    // The ulp of 0.5 is 2^-24, the unit of denormal halves: the addition rounds to it.
    const VF moved = hn::Add(hn::BitCast(df, magnitude), hn::Set(df, 0.5F));
    const VI denormal = hn::Sub(hn::BitCast(di, moved), hn::BitCast(di, hn::Set(df, 0.5F)));

    const VI payload = hn::And(hn::ShiftRight<13>(magnitude), hn::Set(di, 0x03FF));
    const VI lost = hn::And(hn::VecFromMask(di, hn::Eq(payload, hn::Zero(di))), hn::Set(di, 1));
    const VI nan = hn::Or(hn::Or(payload, lost), hn::Set(di, 0x7C00));

    const auto too_big = hn::Gt(magnitude, hn::Set(di, 0x477FEFFF));  // from 65520 on
    VI half = hn::IfThenElse(hn::Lt(magnitude, hn::Set(di, 0x38800000)), denormal, normal);
    half = hn::IfThenElse(too_big, hn::Set(di, 0x7C00), half);
    half = hn::IfThenElse(hn::Gt(magnitude, infinity), nan, half);
    return {hn::Or(half, sign), hn::And(too_big, hn::Lt(magnitude, infinity))};
}

std::size_t FloatToHalf(const float* from, uint16_t* to, std::size_t n) {
    return for_each_vector(from, to, n, [](const float* in, uint16_t* out) HWY_ATTR {
        const Narrowed narrowed = narrow(hn::BitCast(di, hn::LoadU(df, in)));
        hn::StoreU(hn::DemoteTo(U16(), narrowed.half), U16(), out);
        return hn::CountTrue(di, narrowed.overflowed);
    });
}

std::size_t UintToFloat(const uint32_t* from, float* to, std::size_t n) {
    return for_each_vector(from, to, n, [](const uint32_t* in, float* out) HWY_ATTR {
        const VI bits = hn::BitCast(di, hn::LoadU(du, in));
        const VI upper = hn::BitCast(di, hn::ShiftRight<16>(hn::BitCast(du, bits)));
        const VF high = hn::Mul(hn::ConvertTo(df, upper), hn::Set(df, 65536.0F));
        const VF low = hn::ConvertTo(df, hn::And(bits, hn::Set(di, 0xFFFF)));
        const VF sum = hn::Add(high, low);  // both are exact: the only rounding
        hn::StoreU(sum, df, out);
        return hn::CountTrue(df, hn::Ne(hn::Sub(sum, high), low));
    });
}

std::size_t FloatToUint(const float* from, uint32_t* to, std::size_t n) {
    return for_each_vector(from, to, n, [](const float* in, uint32_t* out) HWY_ATTR {
        const VF two31 = hn::Set(df, 0x1p31F);
        const VF value = hn::LoadU(df, in);
        const VF rounded = hn::Round(value);
        const auto fits = hn::And(hn::Ge(rounded, hn::Zero(df)), hn::Lt(rounded, hn::Set(df, 0x1p32F)));
        const VF kept = hn::IfThenElseZero(fits, rounded);
        // The conversion is to signed integers: what lies above them is moved down, and back as bits.
        const auto upper = hn::Ge(kept, two31);
        const VI moved = hn::ConvertTo(di, hn::Sub(kept, hn::IfThenElseZero(upper, two31)));
        const VI top_bit = hn::BitCast(di, hn::IfThenElseZero(upper, hn::Set(df, -0.0F)));
        const VI too_big = hn::VecFromMask(di, hn::RebindMask(di, hn::Ge(rounded, hn::Set(df, 0x1p32F))));
        hn::StoreU(hn::BitCast(du, hn::Or(hn::Xor(moved, top_bit), too_big)), du, out);
        return hn::CountTrue(df, hn::Not(fits));
    });
}

}  // namespace keyline::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace keyline::simd {

HWY_EXPORT(HalfToFloat);
HWY_EXPORT(FloatToHalf);
HWY_EXPORT(UintToFloat);
HWY_EXPORT(FloatToUint);

void half_to_float(const uint16_t* from, float* to, std::size_t n) {
    HWY_DYNAMIC_DISPATCH(HalfToFloat)(from, to, n);
}

std::size_t float_to_half(const float* from, uint16_t* to, std::size_t n) {
    return HWY_DYNAMIC_DISPATCH(FloatToHalf)(from, to, n);
}

std::size_t uint_to_float(const uint32_t* from, float* to, std::size_t n) {
    return HWY_DYNAMIC_DISPATCH(UintToFloat)(from, to, n);
}

std::size_t float_to_uint(const float* from, uint32_t* to, std::size_t n) {
    return HWY_DYNAMIC_DISPATCH(FloatToUint)(from, to, n);
}

}  // namespace keyline::simd
#endif  // HWY_ONCE
