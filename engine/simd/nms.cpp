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

// Which way a gradient points, and what lies on either side of the pixel along it.
//
// "Back" is the left side where the gradient is mostly horizontal and the upper one elsewhere.
struct Direction {
    Mask mostly_x;
    Mask falling;   // the gradient lies along the diagonal that falls to the left
    Mask reversed;  // it points to the back
    Floats w;       // how far it leans to the diagonal neighbour

    HWY_INLINE Direction(Floats dx, Floats dy) {
        const auto along_x = hn::Abs(dx), along_y = hn::Abs(dy);
        mostly_x = hn::Ge(along_x, along_y);
        // Adding +0 makes −0 into +0; then the sign bit alone says which way.
        const auto signed_x = hn::Add(dx, hn::Zero(kFloat)), signed_y = hn::Add(dy, hn::Zero(kFloat));
        falling = has_sign(hn::Xor(signed_x, signed_y));
        reversed = has_sign(hn::IfThenElse(mostly_x, signed_x, signed_y));
        w = hn::Div(hn::IfThenElse(mostly_x, along_y, along_x), hn::IfThenElse(mostly_x, along_x, along_y));
    }

    // What rows of pixels have behind the pixel at i, and before it.
    template <class Memory>
    HWY_INLINE void sides(const Memory& memory, const Rows3& rows, int i, Floats& behind,
                          Floats& before) const {
        const auto pixel = [&](const float* row, int at) HWY_ATTR { return memory.load(kFloat, row, at); };
        const auto up_right = pixel(rows.above, i + 1), down_left = pixel(rows.below, i - 1);
        const auto back = hn::IfThenElse(mostly_x, pixel(rows.at, i - 1), pixel(rows.above, i));
        const auto front = hn::IfThenElse(mostly_x, pixel(rows.at, i + 1), pixel(rows.below, i));
        const auto back_diagonal =
            hn::IfThenElse(falling, hn::IfThenElse(mostly_x, down_left, up_right), pixel(rows.above, i - 1));
        const auto front_diagonal =
            hn::IfThenElse(falling, hn::IfThenElse(mostly_x, up_right, down_left), pixel(rows.below, i + 1));
        const auto at_back = hn::Add(back, hn::Mul(w, hn::Sub(back_diagonal, back)));
        const auto at_front = hn::Add(front, hn::Mul(w, hn::Sub(front_diagonal, front)));
        behind = hn::IfThenElse(reversed, at_front, at_back);
        before = hn::IfThenElse(reversed, at_back, at_front);
    }
};

// The magnitude and the vector of a gradient.
struct Slope {
    const Rows3 &magnitude, &dx, &dy;
};

// Which pixels are kept, of those whose m is above 0.
template <class Memory>
HWY_INLINE Mask stands_out(const Memory& memory, const Slope& slope, Floats dx, Floats dy, Floats m, int i) {
    const Direction direction(dx, dy);
    const auto high = hn::Mul(m, hn::Set(kFloat, 1 + kEqual)), low = hn::Mul(m, hn::Set(kFloat, 1 - kEqual));
    Floats a, b, behind, before_x, before_y;
    direction.sides(memory, slope.magnitude, i, a, b);
    const auto above = hn::Le(a, high), kept = hn::And(above, hn::Lt(b, low));
    const auto tied = hn::AndNot(kept, hn::And(above, hn::Le(b, high)));
    if (HWY_LIKELY(hn::AllFalse(kFloat, tied))) return kept;
    direction.sides(memory, slope.dx, i, behind, before_x);
    direction.sides(memory, slope.dy, i, behind, before_y);
    const auto along = hn::Add(hn::Mul(hn::Div(dx, m), before_x), hn::Mul(hn::Div(dy, m), before_y));
    return hn::Or(kept, hn::And(tied, hn::Lt(along, hn::Zero(kFloat))));
}

void suppress(const Rows3& magnitude, const Rows3& dx_rows, const Rows3& dy_rows, int n,
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
        const auto dx = memory.load(kFloat, dx_rows.at, i), dy = memory.load(kFloat, dy_rows.at, i);
        const auto kept =
            hn::And(positive, stands_out(memory, Slope{magnitude, dx_rows, dy_rows}, dx, dy, m, i));
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

void nms_row(const Rows3& magnitude, const Rows3& dx, const Rows3& dy, int n, Margin margin,
             const GradientRow& out) {
    const int begin = margin.before == 0 ? 1 : 0, end = margin.after == 0 ? n - 1 : n;
    for (float* row : {out.dx, out.dy, out.magnitude}) {
        if (row == nullptr || n == 0) continue;
        if (begin > 0) row[0] = 0;
        if (end < n) row[n - 1] = 0;
    }
    if (begin >= end) return;
    const auto from = [begin](float* row) { return row == nullptr ? nullptr : row + begin; };
    const auto rows_from = [begin](const Rows3& rows) {
        return Rows3{rows.above + begin, rows.at + begin, rows.below + begin};
    };
    HWY_DYNAMIC_DISPATCH(suppress)
    (rows_from(magnitude), rows_from(dx), rows_from(dy), end - begin,
     {from(out.dx), from(out.dy), from(out.magnitude)});
}

}  // namespace keyline::simd
#endif  // HWY_ONCE
