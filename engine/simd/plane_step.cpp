// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/simd/plane_step.h"

// What follows foreach_target.h is compiled once for each target.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/simd/plane_step.cpp"
#include <hwy/foreach_target.h>
#include "engine/simd/rows-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace keyline::simd::HWY_NAMESPACE {

void nearness(const float* depth, int n, double* out) {
    const auto zero = hn::Zero(kDouble), one = hn::Set(kDouble, 1.0);
    for_each_vector(kFewFloats, n, [&](auto memory, int i) HWY_ATTR {
        const auto z = hn::PromoteTo(kDouble, memory.load_own(kFewFloats, depth, i));
        memory.store(hn::IfThenElse(hn::Le(z, zero), zero, hn::Div(one, z)), kDouble, out, i);
    });
}

// Along one axis, from five values in a row but for the one in the middle.
HWY_INLINE Doubles step(Doubles first, Doubles before, Doubles behind, Doubles last) {
    const auto zero = hn::Zero(kDouble), two = hn::Set(kDouble, 2.0);
    const auto difference = hn::Sub(behind, before);
    const auto by_first = hn::Sub(difference, hn::Mul(two, hn::Sub(before, first)));
    const auto by_second = hn::Sub(difference, hn::Mul(two, hn::Sub(last, behind)));
    const auto both = hn::Mul(by_first, by_second);
    const auto less = hn::IfThenElse(hn::Lt(hn::Abs(by_first), hn::Abs(by_second)), by_first, by_second);
    const auto share = hn::Div(less, hn::Max(before, behind));
    return hn::IfThenElse(hn::Gt(both, zero), share, hn::IfThenElse(hn::IsNaN(both), both, zero));
}

void plane_step(const double* const* rows, int n, bool known_x, bool known_y, const PlaneStepRow& out) {
    constexpr int kReach = 2;
    for_each_vector(kFewFloats, n, kReach, {kReach, kReach}, [&](auto memory, int i) HWY_ATTR {
        const auto at = [&](int row, int x)
                            HWY_ATTR { return memory.load(kDouble, rows[kReach + row], i + x); };
        const auto dx = known_x ? step(at(0, -2), at(0, -1), at(0, 1), at(0, 2)) : hn::Zero(kDouble);
        const auto dy = known_y ? step(at(-2, 0), at(-1, 0), at(1, 0), at(2, 0)) : hn::Zero(kDouble);
        const auto magnitude = hn::Sqrt(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)));
        memory.store(rounded(dx), kFewFloats, out.dx, i);
        memory.store(rounded(dy), kFewFloats, out.dy, i);
        memory.store(rounded(magnitude), kFewFloats, out.magnitude, i);
    });
}

}  // namespace keyline::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace keyline::simd {

HWY_EXPORT(nearness);
HWY_EXPORT(plane_step);

void nearness_row(const float* depth, int n, double* out) { HWY_DYNAMIC_DISPATCH(nearness)(depth, n, out); }

void plane_step_row(const std::array<const double*, 5>& rows, int n, bool known_x, bool known_y,
                    const PlaneStepRow& out) {
    HWY_DYNAMIC_DISPATCH(plane_step)(rows.data(), n, known_x, known_y, out);
}

}  // namespace keyline::simd
#endif  // HWY_ONCE
