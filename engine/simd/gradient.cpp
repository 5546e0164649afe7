// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/simd/gradient.h"

// What follows foreach_target.h is compiled once for each target.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/simd/gradient.cpp"
#include <hwy/foreach_target.h>
#include "engine/simd/rows-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace keyline::simd::HWY_NAMESPACE {

struct Central {
    // `load(row, i)` gives pixels as vectors of D.
    template <class D, class Load>
    HWY_INLINE void derive(D, const Load& load, const Rows3& rows, int i, hn::Vec<D>& dx,
                           hn::Vec<D>& dy) const {
        dx = hn::Sub(load(rows.at, i + 1), load(rows.at, i - 1));
        dy = hn::Sub(load(rows.below, i), load(rows.above, i));
    }
};

// [-1 0 1] ⊗ [corner side corner]ᵀ
struct Smoothed {
    double corner, side;

    template <class D, class Load>
    HWY_INLINE void derive(D d, const Load& load, const Rows3& rows, int i, hn::Vec<D>& dx,
                           hn::Vec<D>& dy) const {
        const auto c = hn::Set(d, static_cast<hn::TFromD<D>>(corner)),
                   s = hn::Set(d, static_cast<hn::TFromD<D>>(side));
        const auto above_left = load(rows.above, i - 1), above_right = load(rows.above, i + 1);
        const auto below_left = load(rows.below, i - 1), below_right = load(rows.below, i + 1);
        const auto dx_above = hn::Sub(above_right, above_left), dx_below = hn::Sub(below_right, below_left);
        const auto dy_left = hn::Sub(below_left, above_left), dy_right = hn::Sub(below_right, above_right);
        const auto dx_at = hn::Sub(load(rows.at, i + 1), load(rows.at, i - 1));
        const auto dy_at = hn::Sub(load(rows.below, i), load(rows.above, i));
        dx = hn::Add(hn::Add(hn::Mul(c, dx_above), hn::Mul(c, dx_below)), hn::Mul(s, dx_at));
        dy = hn::Add(hn::Add(hn::Mul(c, dy_left), hn::Mul(c, dy_right)), hn::Mul(s, dy_at));
    }
};

// √(x² + y²) where a square may leave float's range: both sides are first scaled by a power of two.
HWY_INLINE Floats scaled_length(Floats x, Floats y) {
    const auto large = hn::Gt(hn::Max(hn::Abs(x), hn::Abs(y)), hn::Set(kFloat, 1.0F));
    const auto up = hn::Set(kFloat, 0x1p100F), down = hn::Set(kFloat, 0x1p-100F);
    const auto scale = hn::IfThenElse(large, down, up), back = hn::IfThenElse(large, up, down);
    const auto sx = hn::Mul(x, scale), sy = hn::Mul(y, scale);
    return hn::Mul(hn::Sqrt(hn::Add(hn::Mul(sx, sx), hn::Mul(sy, sy))), back);
}

// √(dx² + dy²), and dx and dy with one NaN.  Out of the ordinary are lanes with a NaN, an infinity, or a
// square near the ends of float's range; whole vectors without one, which is nearly all, are spared the care.
HWY_INLINE Floats length(Floats& dx, Floats& dy) {
    const auto squares = hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy));
    const auto in_range =
        hn::And(hn::Ge(squares, hn::Set(kFloat, 0x1p-80F)), hn::Le(squares, hn::Set(kFloat, 0x1p120F)));
    const auto both_zero = hn::Eq(hn::Abs(hn::Or(dx, dy)), hn::Zero(kFloat));
    const auto ordinary = hn::Or(in_range, both_zero);
    const auto magnitude = hn::Sqrt(squares);
    if (HWY_LIKELY(hn::AllTrue(kFloat, ordinary))) return magnitude;
    const auto careful = hn::IfThenElse(ordinary, magnitude, scaled_length(dx, dy));
    dx = with_one_nan(dx);
    dy = with_one_nan(dy);
    return with_one_nan(careful);
}

template <class Operator>
HWY_INLINE void gradient_of_one(const Operator& op, const Rows3& rows, int n, Margin margin,
                                const GradientRow& out) {
    for_each_vector(kFloat, n, 1, margin, [&](auto memory, int i) HWY_ATTR {
        const auto load = [&](const float* row, int at) HWY_ATTR { return memory.load(kFloat, row, at); };
        Floats dx, dy;
        op.derive(kFloat, load, rows, i, dx, dy);
        const auto magnitude = length(dx, dy);
        memory.store(dx, kFloat, out.dx, i);
        memory.store(dy, kFloat, out.dy, i);
        memory.store(magnitude, kFloat, out.magnitude, i);
    });
}

// Di Zenzo's tensor [xx, xy; xy, yy].
struct Tensor {
    Doubles xx, xy, yy;
};

// The larger eigenvalue's root, and its eigenvector of that length.  With h = (xx − yy) / 2 and r = √(h² +
// xy²), (r + h, xy) and (xy, r − h) are both eigenvectors, of length √(2 r (r ± h)); the one that does not
// cancel is taken.
HWY_INLINE void solve(const Tensor& j, Doubles& x, Doubles& y, Doubles& magnitude) {
    const auto half = hn::Set(kDouble, 0.5), zero = hn::Zero(kDouble);
    const auto h = hn::Mul(half, hn::Sub(j.xx, j.yy));
    const auto r = hn::Sqrt(hn::Add(hn::Mul(h, h), hn::Mul(j.xy, j.xy)));
    const auto eigenvalue = hn::Add(hn::Mul(half, hn::Add(j.xx, j.yy)), r);
    magnitude = hn::Sqrt(eigenvalue);

    const auto mostly_x = hn::Ge(h, zero);
    const auto sum = hn::Add(r, hn::Abs(h));
    const auto vx = hn::IfThenElse(mostly_x, sum, hn::Abs(j.xy));
    const auto vy = hn::IfThenElse(mostly_x, j.xy, hn::IfThenElse(hn::Lt(j.xy, zero), hn::Neg(sum), sum));
    const auto to_length = hn::Sqrt(hn::Div(eigenvalue, hn::Mul(hn::Add(r, r), sum)));
    const auto any_direction = hn::Eq(r, zero);
    x = hn::IfThenElse(any_direction, magnitude, hn::Mul(to_length, vx));
    y = hn::IfThenElse(any_direction, zero, hn::Mul(to_length, vy));
}

template <class Operator>
HWY_INLINE void gradient_of_several(const Operator& op, const Rows3* channels, size_t count, int n,
                                    Margin margin, const GradientRow& out) {
    for_each_vector(kFewFloats, n, 1, margin, [&](auto memory, int i) HWY_ATTR {
        const auto load = [&](const float* row, int at)
                              HWY_ATTR { return hn::PromoteTo(kDouble, memory.load(kFewFloats, row, at)); };
        Tensor j{hn::Zero(kDouble), hn::Zero(kDouble), hn::Zero(kDouble)};
        for (size_t c = 0; c < count; ++c) {
            Doubles dx, dy;
            op.derive(kDouble, load, channels[c], i, dx, dy);
            j.xx = hn::Add(j.xx, hn::Mul(dx, dx));
            j.xy = hn::Add(j.xy, hn::Mul(dx, dy));
            j.yy = hn::Add(j.yy, hn::Mul(dy, dy));
        }
        Doubles x, y, magnitude;
        solve(j, x, y, magnitude);
        memory.store(rounded(x), kFewFloats, out.dx, i);
        memory.store(rounded(y), kFewFloats, out.dy, i);
        memory.store(rounded(magnitude), kFewFloats, out.magnitude, i);
    });
}

template <class Operator>
HWY_INLINE void gradient_with(const Operator& op, const Rows3* channels, size_t count, int n, Margin margin,
                              const GradientRow& out) {
    if (count == 1)
        gradient_of_one(op, channels[0], n, margin, out);
    else
        gradient_of_several(op, channels, count, n, margin, out);
}

void gradient(GradientOperator op, const Rows3* channels, size_t count, int n, Margin margin,
              const GradientRow& out) {
    switch (op) {
        case GradientOperator::kCentral: return gradient_with(Central(), channels, count, n, margin, out);
        case GradientOperator::kSobel:
            return gradient_with(Smoothed{1.0 / 8, 2.0 / 8}, channels, count, n, margin, out);
        case GradientOperator::kPrewitt:
            return gradient_with(Smoothed{1.0 / 6, 1.0 / 6}, channels, count, n, margin, out);
        case GradientOperator::kScharr:
            return gradient_with(Smoothed{3.0 / 32, 10.0 / 32}, channels, count, n, margin, out);
    }
}

}  // namespace keyline::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace keyline::simd {

HWY_EXPORT(gradient);

void gradient_row(GradientOperator op, std::span<const Rows3> channels, int n, Margin margin,
                  const GradientRow& out) {
    HWY_DYNAMIC_DISPATCH(gradient)(op, channels.data(), channels.size(), n, margin, out);
}

}  // namespace keyline::simd
#endif  // HWY_ONCE
