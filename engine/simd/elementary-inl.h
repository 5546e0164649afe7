// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0

// exp, log and pow on vectors of double: the one body behind elementary.h and the kernels.  Compiled once for
// each instruction set, so the guard below is Highway's and not an ordinary one.

#if defined(KEYLINE_ENGINE_SIMD_ELEMENTARY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef KEYLINE_ENGINE_SIMD_ELEMENTARY_INL_H_
#undef KEYLINE_ENGINE_SIMD_ELEMENTARY_INL_H_
#else
#define KEYLINE_ENGINE_SIMD_ELEMENTARY_INL_H_
#endif

#include <hwy/highway.h>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace keyline::simd::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// ln 2 in two parts; the high one ends in 21 zero bits, so that a whole number of them below 2^21 is exact.
inline constexpr double kLn2High = 0x1.62e42fefp-1;
inline constexpr double kLn2Low = 0x1.473de6af278edp-34;

// A number this large has no bits below the point, so adding it rounds to the nearest integer, which is then
// found in its lowest bits.  (Conversion between double and int64 has no instruction before AVX-512.)
inline constexpr double kRounder = 0x1.8p52;

// c[0] + x (c[1] + x (c[2] + …))
template <class D, size_t kCount>
HWY_INLINE hn::Vec<D> polynomial(D d, hn::Vec<D> x, const double (&c)[kCount]) {
    auto sum = hn::Set(d, c[kCount - 1]);
    for (size_t i = kCount - 1; i-- > 0;) sum = hn::Add(hn::Mul(sum, x), hn::Set(d, c[i]));
    return sum;
}

// 2^k, for the whole number k = (rounder + k) − rounder in −1022 … 1023.
template <class D>
HWY_INLINE hn::Vec<D> power_of_two(D d, hn::Vec<D> rounder_and_k) {
    const hn::Rebind<int64_t, D> di;
    const auto biased = hn::Add(hn::BitCast(di, rounder_and_k), hn::Set(di, 1023));
    return hn::BitCast(d, hn::ShiftLeft<52>(biased));
}

template <class D>
HWY_INLINE hn::Vec<D> exp(D d, hn::Vec<D> x) {
    // 1/k!: the Taylor series, which at |r| ≤ ln 2 / 2 needs no help.
    static constexpr double kSeries[] = {1.0,
                                         1.0,
                                         1.0 / 2,
                                         1.0 / 6,
                                         1.0 / 24,
                                         1.0 / 120,
                                         1.0 / 720,
                                         1.0 / 5040,
                                         1.0 / 40320,
                                         1.0 / 362880,
                                         1.0 / 3628800,
                                         1.0 / 39916800,
                                         1.0 / 479001600,
                                         1.0 / 6227020800};
    // Beyond these the result is 0 or infinite; NaN fails both comparisons and stays.
    const auto low = hn::Set(d, -746.0), high = hn::Set(d, 710.0);
    x = hn::IfThenElse(hn::Lt(x, low), low, x);
    x = hn::IfThenElse(hn::Gt(x, high), high, x);

    const auto rounder = hn::Set(d, kRounder);
    const auto k_rounded = hn::Add(hn::Mul(x, hn::Set(d, 0x1.71547652b82fep0)), rounder);
    const auto k = hn::Sub(k_rounded, rounder);
    const auto r = hn::Sub(hn::Sub(x, hn::Mul(k, hn::Set(d, kLn2High))), hn::Mul(k, hn::Set(d, kLn2Low)));
    const auto power = polynomial(d, r, kSeries);

    // 2^k in two factors: one alone would overflow, or lose denormal results, at the ends.
    const auto half_rounded = hn::Add(hn::Mul(k, hn::Set(d, 0.5)), rounder);
    const auto half = hn::Sub(half_rounded, rounder);
    const auto rest_rounded = hn::Add(hn::Sub(k, half), rounder);
    return hn::Mul(hn::Mul(power, power_of_two(d, half_rounded)), power_of_two(d, rest_rounded));
}

template <class D>
HWY_INLINE hn::Vec<D> log(D d, hn::Vec<D> x) {
    // 2/3, 2/5, …: log((1 + s) / (1 − s)) = 2s + s³ (2/3 + 2/5 s² + …), |s| ≤ 0.172
    static constexpr double kSeries[] = {2.0 / 3,  2.0 / 5,  2.0 / 7,  2.0 / 9,  2.0 / 11,
                                         2.0 / 13, 2.0 / 15, 2.0 / 17, 2.0 / 19, 2.0 / 21};
    const hn::Rebind<int64_t, D> di;
    const auto denormal = hn::Lt(x, hn::Set(d, std::numeric_limits<double>::min()));
    const auto normal = hn::IfThenElse(denormal, hn::Mul(x, hn::Set(d, 0x1p54)), x);

    // x = 2^k × m with m in [√½, √2): the exponent as if counted from √½.
    const auto bits = hn::BitCast(di, normal);
    const auto from_root_half = hn::Sub(bits, hn::Set(di, 0x3FE6A09E667F3BCD));
    // An arithmetic shift by 52 from logical ones: k + 1024 is never negative.
    const auto shifted = hn::Add(from_root_half, hn::Set(di, int64_t{1024} << 52));
    const auto k_bits =
        hn::BitCast(di, hn::ShiftRight<52>(hn::BitCast(hn::RebindToUnsigned<decltype(di)>(), shifted)));
    const auto k_rounded = hn::BitCast(d, hn::Add(k_bits, hn::BitCast(di, hn::Set(d, kRounder))));
    const auto k_normal = hn::Sub(hn::Sub(k_rounded, hn::Set(d, kRounder)), hn::Set(d, 1024.0));
    const auto k = hn::IfThenElse(denormal, hn::Sub(k_normal, hn::Set(d, 54.0)), k_normal);
    const auto m_bits = hn::Sub(bits, hn::ShiftLeft<52>(hn::Sub(k_bits, hn::Set(di, 1024))));
    const auto f = hn::Sub(hn::BitCast(d, m_bits), hn::Set(d, 1.0));

    // log m = f − (f²/2 − s (f²/2 + R)): f is exact and what is taken from it is small, so little is lost.
    const auto s = hn::Div(f, hn::Add(hn::Set(d, 2.0), f));
    const auto s2 = hn::Mul(s, s);
    const auto remainder = hn::Mul(s2, polynomial(d, s2, kSeries));
    const auto half_f2 = hn::Mul(hn::Mul(f, f), hn::Set(d, 0.5));
    const auto correction = hn::Mul(s, hn::Add(half_f2, remainder));
    const auto low = hn::Add(correction, hn::Mul(k, hn::Set(d, kLn2Low)));
    const auto finite = hn::Add(hn::Mul(k, hn::Set(d, kLn2High)), hn::Sub(f, hn::Sub(half_f2, low)));

    const auto infinity = hn::Set(d, std::numeric_limits<double>::infinity());
    auto result = hn::IfThenElse(hn::Lt(x, infinity), finite, x);  // +∞ and NaN stay
    result = hn::IfThenElse(hn::Eq(x, hn::Zero(d)), hn::Neg(infinity), result);
    return hn::IfThenElse(hn::Lt(x, hn::Zero(d)), hn::Set(d, std::numeric_limits<double>::quiet_NaN()),
                          result);
}

// x ≥ 0, not NaN; y the same for all lanes, finite and not 0.
template <class D>
HWY_INLINE hn::Vec<D> pow(D d, hn::Vec<D> x, double y) {
    return exp(d, hn::Mul(hn::Set(d, y), log(d, x)));
}

}  // namespace keyline::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // the guard
