// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/simd/shading.h"

#include "engine/simd/rows.h"

// What follows foreach_target.h is compiled once for each target.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/simd/shading.cpp"
#include <hwy/foreach_target.h>
#include "engine/simd/elementary-inl.h"
#include "engine/simd/rows-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace keyline::simd::HWY_NAMESPACE {

struct Vector3 {
    Doubles x, y, z;
};

HWY_INLINE Doubles set(double v) { return hn::Set(kDouble, v); }

template <class Memory>
HWY_INLINE Doubles load(Memory memory, const float* row, int i) {
    return hn::PromoteTo(kDouble, memory.load(kFewFloats, row, i));
}

template <class Memory>
HWY_INLINE Vector3 load(Memory memory, const XyzRows& rows, int i) {
    return {load(memory, rows.x, i), load(memory, rows.y, i), load(memory, rows.z, i)};
}

template <class Memory>
HWY_INLINE Vector3 load(Memory memory, const UnitRows& rows, int i) {
    return {memory.load(kDouble, rows.x, i), memory.load(kDouble, rows.y, i),
            memory.load(kDouble, rows.z, i)};
}

HWY_INLINE Doubles dot(const Vector3& a, const Vector3& b) {
    return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

HWY_INLINE Doubles larger_than_zero(Doubles v) {
    const auto zero = hn::Zero(kDouble);
    return hn::IfThenElse(hn::Gt(v, zero), v, zero);
}

// 1 ÷ v; 0 for 0.
HWY_INLINE Doubles inverse_or_zero(Doubles v) {
    const auto zero = hn::Zero(kDouble);
    return hn::IfThenElse(hn::Eq(v, zero), zero, hn::Div(set(1), v));
}

template <class Memory>
HWY_INLINE void store_unit(Memory memory, const Vector3& v, Doubles square, const UnitRows& out, int i) {
    const auto zero = hn::Zero(kDouble);
    const auto infinite = hn::Eq(square, set(std::numeric_limits<double>::infinity()));
    const auto scale = inverse_or_zero(hn::Sqrt(square));
    memory.store(hn::IfThenElse(infinite, zero, hn::Mul(v.x, scale)), kDouble, out.x, i);
    memory.store(hn::IfThenElse(infinite, zero, hn::Mul(v.y, scale)), kDouble, out.y, i);
    memory.store(hn::IfThenElse(infinite, zero, hn::Mul(v.z, scale)), kDouble, out.z, i);
}

void unit(const XyzRows& rows, int n, const UnitRows& out) {
    for_each_vector(kDouble, n, [&](auto memory, int i) HWY_ATTR {
        const Vector3 v = load(memory, rows, i);
        store_unit(memory, v, dot(v, v), out, i);
    });
}

void toward(const XyzRows& position, const std::array<double, 3>& point, int n, const UnitRows& out,
            double* inverse_square) {
    for_each_vector(kDouble, n, [&](auto memory, int i) HWY_ATTR {
        const Vector3 p = load(memory, position, i);
        const Vector3 v{hn::Sub(set(point[0]), p.x), hn::Sub(set(point[1]), p.y),
                        hn::Sub(set(point[2]), p.z)};
        const auto square = dot(v, v);
        store_unit(memory, v, square, out, i);
        memory.store(inverse_or_zero(square), kDouble, inverse_square, i);
    });
}

void dot_constant(const UnitRows& a, const std::array<double, 3>& b, int n, double* out) {
    for_each_vector(kDouble, n, [&](auto memory, int i) HWY_ATTR {
        memory.store(dot(load(memory, a, i), {set(b[0]), set(b[1]), set(b[2])}), kDouble, out, i);
    });
}

void dot_rows(const UnitRows& a, const UnitRows& b, int n, double* out) {
    for_each_vector(kDouble, n, [&](auto memory, int i) HWY_ATTR {
        memory.store(dot(load(memory, a, i), load(memory, b, i)), kDouble, out, i);
    });
}

void covered(const float* coverage, const UnitRows& normal, int n, double* out) {
    const auto zero = hn::Zero(kDouble);
    for_each_vector(kDouble, n, [&](auto memory, int i) HWY_ATTR {
        const Vector3 v = load(memory, normal, i);
        const auto here = coverage != nullptr ? load(memory, coverage, i) : set(1);
        const auto none = hn::And(hn::And(hn::Eq(v.x, zero), hn::Eq(v.y, zero)), hn::Eq(v.z, zero));
        memory.store(hn::IfThenElse(none, zero, here), kDouble, out, i);
    });
}

void reach(const double* by, const float* a, const float* b, int n, double* out) {
    for_each_vector(kDouble, n, [&](auto memory, int i) HWY_ATTR {
        auto product = by != nullptr ? memory.load(kDouble, by, i) : set(1);
        if (a != nullptr) product = hn::Mul(product, load(memory, a, i));
        if (b != nullptr) product = hn::Mul(product, load(memory, b, i));
        memory.store(product, kDouble, out, i);
    });
}

// A colour C = Cs × by + plus, built up channel by channel.
struct Shade {
    Doubles by[3], plus[3];
};

// Os × C without a division: Os × Cs is the premultiplied colour.
template <class Memory>
HWY_INLINE void store_shaded(Memory memory, const SurfaceRows& surface, const Shade& shade, int i,
                             const ShadedRows& out) {
    const auto zero = hn::Zero(kDouble);
    const auto covered = memory.load(kDouble, surface.coverage, i);
    const auto none = hn::Eq(covered, zero);
    const float* colours[] = {surface.r, surface.g, surface.b};
    float* const rows[] = {out.r, out.g, out.b};
    Doubles result[3];
    for (int c = 0; c < 3; ++c) {
        const auto colour = load(memory, colours[c], i);
        const auto whole = surface.premultiplied ? colour : hn::Mul(colour, covered);
        const auto sum = hn::Add(hn::Mul(whole, shade.by[c]), hn::Mul(covered, shade.plus[c]));
        result[c] = hn::IfThenElse(none, zero, sum);
        memory.store(rounded(result[c]), kFewFloats, rows[c], i);
    }
    const auto grey = hn::Add(hn::Add(hn::Mul(result[0], set(0.299)), hn::Mul(result[1], set(0.587))),
                              hn::Mul(result[2], set(0.114)));
    memory.store(rounded(covered), kFewFloats, out.a, i);
    memory.store(rounded(grey), kFewFloats, out.y, i);
}

// What the kernels are told they copy first: for all the compiler knows, a row that is written to may lie on
// it, and it would be read, and divided by, again for every vector.

// Of a NaN it is 0.
HWY_INLINE Doubles smooth_step(const SmoothStep& step, Doubles v) {
    const auto low = set(step.low), high = set(step.high);
    const auto inside = hn::Mul(hn::Sub(v, low), set(1 / (step.high - step.low)));
    const auto t =
        hn::IfThenElse(hn::Ge(v, high), set(1), hn::IfThenElse(hn::Gt(v, low), inside, hn::Zero(kDouble)));
    return hn::Mul(hn::Mul(t, t), hn::Sub(set(3), hn::Add(t, t)));
}

// ½ (1 + L·N): the whole sphere around the normal counts.
template <class Memory>
HWY_INLINE Doubles wrapped(Memory memory, const LightRows& light, int i) {
    return hn::Mul(set(0.5), hn::Add(set(1), memory.load(kDouble, light.facing, i)));
}

template <class Memory>
HWY_INLINE Doubles reach_of(Memory memory, const LightRows& light, int i) {
    return light.reach != nullptr ? memory.load(kDouble, light.reach, i) : set(1);
}

// Sums over the lights.  With tᵢ the tone, Σ mix(shade, light × colourᵢ × reachᵢ, tᵢ) is
// shade × Σ (1 − tᵢ) + light × Σ colourᵢ × reachᵢ × tᵢ.
struct CelSums {
    Doubles dark, squares;
    Doubles lit[3], shine[3];
};

template <bool kHighlight, class Memory>
HWY_INLINE void add_light(Memory memory, const LightRows& light, const CelTones& tones, int i,
                          CelSums& sums) {
    const auto reach = reach_of(memory, light, i), t = memory.load(kDouble, light.own, i);
    const auto tone = hn::Mul(reach, t);
    sums.dark = hn::Add(sums.dark, hn::Sub(set(1), t));
    for (size_t c = 0; c < 3; ++c) sums.lit[c] = hn::Add(sums.lit[c], hn::Mul(set(light.color[c]), tone));
    if (!kHighlight) return;
    const auto v = wrapped(memory, light, i);
    const auto counts = hn::Gt(v, set(tones.threshold));
    sums.squares = hn::Add(sums.squares, hn::IfThenElse(counts, hn::Mul(v, v), hn::Zero(kDouble)));
    for (size_t c = 0; c < 3; ++c)
        sums.shine[c] = hn::Add(sums.shine[c], hn::Mul(set(light.color[c]), reach));
}

template <bool kHighlight>
HWY_INLINE Shade cel_shade(const CelTones& tones, const CelSums& sums) {
    const auto zero = hn::Zero(kDouble);
    const auto dark = hn::Mul(set(tones.shade), sums.dark);
    const auto shown = hn::Gt(sums.squares, zero);
    const auto t = kHighlight ? smooth_step(tones.highlight, sums.squares) : zero;
    Shade shade{{zero, zero, zero}, {zero, zero, zero}};
    for (size_t c = 0; c < 3; ++c) {
        const auto brightness = hn::Add(dark, hn::Mul(set(tones.light), sums.lit[c]));
        shade.by[c] = hn::Add(set(tones.ambient[c]), hn::Mul(set(tones.diffuse), brightness));
        if (!kHighlight) continue;
        const auto mixed = hn::Add(brightness, hn::Mul(hn::Sub(set(tones.tint), brightness), t));
        const auto white = hn::Add(set(tones.gleam), hn::Mul(set(tones.shine), sums.shine[c]));
        shade.by[c] = hn::IfThenElse(shown, mixed, shade.by[c]);
        shade.plus[c] = hn::IfThenElse(shown, hn::Mul(white, t), zero);
    }
    return shade;
}

// Before all else and by themselves: in short loops the processor works on many vectors at once, where one
// long chain of operations would have it wait.
void cel_tones(const LightRows& of_light, const CelTones& of_tones, int n) {
    const LightRows light = of_light;
    const CelTones tones = of_tones;
    for_each_vector(kDouble, n, [&](auto memory, int i) HWY_ATTR {
        const auto v = wrapped(memory, light, i);
        memory.store(tones.continuous ? v : smooth_step(tones.transition, v), kDouble, light.own, i);
    });
}

template <bool kHighlight>
void cel_of(const SurfaceRows& of_surface, std::span<const LightRows> lights, const CelTones& of_tones, int n,
            const ShadedRows& to) {
    const SurfaceRows surface = of_surface;
    const CelTones tones = of_tones;
    const ShadedRows out = to;
    for_each_vector(kDouble, n, [&](auto memory, int i) HWY_ATTR {
        const auto zero = hn::Zero(kDouble);
        CelSums sums{zero, zero, {zero, zero, zero}, {zero, zero, zero}};
        for (const LightRows& light : lights) add_light<kHighlight>(memory, light, tones, i, sums);
        store_shaded(memory, surface, cel_shade<kHighlight>(tones, sums), i, out);
    });
}

void cel(const SurfaceRows& surface, std::span<const LightRows> lights, const CelTones& tones, int n,
         const ShadedRows& out) {
    for (const LightRows& light : lights) cel_tones(light, tones, n);
    if (tones.has_highlight)
        cel_of<true>(surface, lights, tones, n, out);
    else
        cel_of<false>(surface, lights, tones, n, out);
}

void gooch(const SurfaceRows& of_surface, std::span<const LightRows> lights, const GoochTones& of_tones,
           int n, const ShadedRows& to) {
    const SurfaceRows surface = of_surface;
    const GoochTones tones = of_tones;
    const ShadedRows out = to;
    const double count = static_cast<double>(lights.size());
    for_each_vector(kDouble, n, [&](auto memory, int i) HWY_ATTR {
        auto sum = hn::Zero(kDouble);
        for (const LightRows& light : lights) sum = hn::Add(sum, wrapped(memory, light, i));
        const auto mixed = [&](double cool, double warm) HWY_ATTR {
            return hn::Add(set(count * cool), hn::Mul(set(warm - cool), sum));
        };
        const auto by = mixed(tones.alpha, tones.beta);
        Shade shade{{by, by, by}, {}};
        for (size_t c = 0; c < 3; ++c) shade.plus[c] = mixed(tones.cool[c], tones.warm[c]);
        store_shaded(memory, surface, shade, i, out);
    });
}

void phong(const SurfaceRows& of_surface, std::span<const LightRows> lights, const double* normal_toward_eye,
           const PhongTones& of_tones, int n, const ShadedRows& to) {
    const SurfaceRows surface = of_surface;
    const PhongTones tones = of_tones;
    const ShadedRows out = to;
    for_each_vector(kDouble, n, [&](auto memory, int i) HWY_ATTR {
        const auto zero = hn::Zero(kDouble);
        const auto normal_eye = memory.load(kDouble, normal_toward_eye, i);
        Shade shade{{set(tones.ambient[0]), set(tones.ambient[1]), set(tones.ambient[2])},
                    {zero, zero, zero}};
        for (const LightRows& light : lights) {
            const auto facing = memory.load(kDouble, light.facing, i), reach = reach_of(memory, light, i);
            // R = 2 (L·N) N − L
            const auto mirrored =
                hn::Sub(hn::Mul(hn::Add(facing, facing), normal_eye), memory.load(kDouble, light.own, i));
            const auto diffuse = hn::Mul(set(tones.diffuse), larger_than_zero(facing));
            const auto specular =
                hn::Mul(set(tones.specular), pow(kDouble, larger_than_zero(mirrored), tones.exponent));
            for (size_t c = 0; c < 3; ++c) {
                const auto colour = hn::Mul(set(light.color[c]), reach);
                shade.by[c] = hn::Add(shade.by[c], hn::Mul(colour, diffuse));
                shade.plus[c] = hn::Add(shade.plus[c], hn::Mul(colour, specular));
            }
        }
        store_shaded(memory, surface, shade, i, out);
    });
}

}  // namespace keyline::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace keyline::simd {

HWY_EXPORT(unit);
HWY_EXPORT(toward);
HWY_EXPORT(dot_constant);
HWY_EXPORT(dot_rows);
HWY_EXPORT(covered);
HWY_EXPORT(reach);
HWY_EXPORT(cel);
HWY_EXPORT(gooch);
HWY_EXPORT(phong);

void unit_row(const XyzRows& v, int n, const UnitRows& out) { HWY_DYNAMIC_DISPATCH(unit)(v, n, out); }

void toward_row(const XyzRows& position, const std::array<double, 3>& point, int n, const UnitRows& out,
                double* inverse_square) {
    HWY_DYNAMIC_DISPATCH(toward)(position, point, n, out, inverse_square);
}

void dot_row(const UnitRows& a, const std::array<double, 3>& b, int n, double* out) {
    HWY_DYNAMIC_DISPATCH(dot_constant)(a, b, n, out);
}

void dot_row(const UnitRows& a, const UnitRows& b, int n, double* out) {
    HWY_DYNAMIC_DISPATCH(dot_rows)(a, b, n, out);
}

void covered_row(const float* coverage, const UnitRows& normal, int n, double* out) {
    HWY_DYNAMIC_DISPATCH(covered)(coverage, normal, n, out);
}

void reach_row(const double* by, const float* a, const float* b, int n, double* out) {
    HWY_DYNAMIC_DISPATCH(reach)(by, a, b, n, out);
}

void cel_row(const SurfaceRows& surface, std::span<const LightRows> lights, const CelTones& tones, int n,
             const ShadedRows& out) {
    HWY_DYNAMIC_DISPATCH(cel)(surface, lights, tones, n, out);
}

void gooch_row(const SurfaceRows& surface, std::span<const LightRows> lights, const GoochTones& tones, int n,
               const ShadedRows& out) {
    HWY_DYNAMIC_DISPATCH(gooch)(surface, lights, tones, n, out);
}

void phong_row(const SurfaceRows& surface, std::span<const LightRows> lights, const double* normal_toward_eye,
               const PhongTones& tones, int n, const ShadedRows& out) {
    HWY_DYNAMIC_DISPATCH(phong)(surface, lights, normal_toward_eye, tones, n, out);
}

}  // namespace keyline::simd
#endif  // HWY_ONCE
