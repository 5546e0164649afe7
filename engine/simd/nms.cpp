// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/simd/nms.h"

// What follows foreach_target.h is compiled once for each target.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/simd/nms.cpp"
#include <hwy/foreach_target.h>
#include "engine/simd/rows-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace keyline::simd::HWY_NAMESPACE {

using Mask = hn::Mask<FloatTag>;

// Where the sign bit is set, of −0 too.
HWY_INLINE Mask has_sign(Floats v) {
    const hn::RebindToSigned<FloatTag> as_int;
    return hn::RebindMask(kFloat, hn::Lt(hn::BitCast(as_int, v), hn::Zero(as_int)));
}

// Which pixels are kept, of those whose m is above 0.
//
// Of the two sides between which the pixel must stand out, "back" is the left one where the gradient is
// mostly horizontal and the upper one elsewhere.  It is the formula's A where the gradient points right (or
// down), and its B elsewhere.
template <class Memory>
HWY_INLINE Mask stands_out(const Memory& memory, const Rows3& magnitude, Floats dx, Floats dy, Floats m,
                           int i) {
    const auto pixel = [&](const float* row, int at) HWY_ATTR { return memory.load(kFloat, row, at); };
    const auto zero = hn::Zero(kFloat);
    const auto along_x = hn::Abs(dx), along_y = hn::Abs(dy);
    const auto mostly_x = hn::Ge(along_x, along_y);
    // Adding +0 makes −0 into +0; then the sign bit alone says which way.
    const auto signed_x = hn::Add(dx, zero), signed_y = hn::Add(dy, zero);
    const auto falling = has_sign(hn::Xor(signed_x, signed_y));  // the gradient lies along the other diagonal

    const auto up_right = pixel(magnitude.above, i + 1), down_left = pixel(magnitude.below, i - 1);
    const auto back = hn::IfThenElse(mostly_x, pixel(magnitude.at, i - 1), pixel(magnitude.above, i));
    const auto front = hn::IfThenElse(mostly_x, pixel(magnitude.at, i + 1), pixel(magnitude.below, i));
    const auto back_diagonal =
        hn::IfThenElse(falling, hn::IfThenElse(mostly_x, down_left, up_right), pixel(magnitude.above, i - 1));
    const auto front_diagonal =
        hn::IfThenElse(falling, hn::IfThenElse(mostly_x, up_right, down_left), pixel(magnitude.below, i + 1));

    const auto shorter = hn::IfThenElse(mostly_x, along_y, along_x);
    const auto longer = hn::IfThenElse(mostly_x, along_x, along_y);
    const auto w = hn::Div(shorter, longer);
    const auto m_back = hn::Add(back, hn::Mul(w, hn::Sub(back_diagonal, back)));
    const auto m_front = hn::Add(front, hn::Mul(w, hn::Sub(front_diagonal, front)));

    const auto reversed = has_sign(hn::IfThenElse(mostly_x, signed_x, signed_y));
    const auto a = hn::IfThenElse(reversed, m_front, m_back);
    const auto b = hn::IfThenElse(reversed, m_back, m_front);
    return hn::And(hn::Le(a, m), hn::Lt(b, m));
}

void suppress(const Rows3& magnitude, const float* dx_row, const float* dy_row, int n,
              const GradientRow& out) {
    for_each_vector(kFloat, n, 1, {1, 1}, [&](auto memory, int i) HWY_ATTR {
        const auto store = [&](Floats value, float* row) HWY_ATTR {
            if (row != nullptr) memory.store(value, kFloat, row, i);
        };
        const auto m = memory.load(kFloat, magnitude.at, i), zero = hn::Zero(kFloat);
        const auto positive = hn::Gt(m, zero);
        if (hn::AllFalse(kFloat, positive)) {  // flat, as much of a flat-shaded picture is
            for (float* row : {out.dx, out.dy, out.magnitude}) store(zero, row);
            return;
        }
        const auto dx = memory.load_own(kFloat, dx_row, i), dy = memory.load_own(kFloat, dy_row, i);
        const auto kept = hn::And(positive, stands_out(memory, magnitude, dx, dy, m, i));
        store(hn::IfThenElseZero(kept, dx), out.dx);
        store(hn::IfThenElseZero(kept, dy), out.dy);
        store(hn::IfThenElseZero(kept, m), out.magnitude);
    });
}

}  // namespace keyline::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace keyline::simd {

HWY_EXPORT(suppress);

void nms_row(const Rows3& magnitude, const float* dx, const float* dy, int n, Margin margin,
             const GradientRow& out) {
    const int begin = margin.before == 0 ? 1 : 0, end = margin.after == 0 ? n - 1 : n;
    for (float* row : {out.dx, out.dy, out.magnitude}) {
        if (row == nullptr || n == 0) continue;
        if (begin > 0) row[0] = 0;
        if (end < n) row[n - 1] = 0;
    }
    if (begin >= end) return;
    const auto from = [begin](float* row) { return row == nullptr ? nullptr : row + begin; };
    HWY_DYNAMIC_DISPATCH(suppress)
    ({magnitude.above + begin, magnitude.at + begin, magnitude.below + begin}, dx + begin, dy + begin,
     end - begin, {from(out.dx), from(out.dy), from(out.magnitude)});
}

}  // namespace keyline::simd
#endif  // HWY_ONCE
