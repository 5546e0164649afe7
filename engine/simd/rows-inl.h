// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0

// How the kernels walk a row.  A kernel's body is written once, for one vector of pixels, and given one of
// two ways to reach memory: Whole, for a vector that lies inside the row, and Part, which goes lane by lane
// for the ends of a row.  The arithmetic between is the same, and so are the bits.
//
// Compiled once for each instruction set, so the guard below is Highway's and not an ordinary one.

#if defined(KEYLINE_ENGINE_SIMD_ROWS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef KEYLINE_ENGINE_SIMD_ROWS_INL_H_
#undef KEYLINE_ENGINE_SIMD_ROWS_INL_H_
#else
#define KEYLINE_ENGINE_SIMD_ROWS_INL_H_
#endif

#include <hwy/highway.h>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace keyline::simd::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::ScalableTag<float>;
using Floats = hn::Vec<FloatTag>;
constexpr FloatTag kFloat;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(kFloat));

// Which of two NaNs a sum passes on depends on how the compiler ordered it, so results have one NaN only.
HWY_INLINE Floats with_one_nan(Floats v) {
    return hn::IfThenElse(hn::IsNaN(v), hn::Set(kFloat, std::numeric_limits<float>::quiet_NaN()), v);
}

struct Whole {
    template <class T>
    HWY_INLINE hn::Vec<hn::ScalableTag<T>> load(const T* row, int i) const {
        return hn::LoadU(hn::ScalableTag<T>(), row + i);
    }
    template <class T>
    HWY_INLINE void store(hn::Vec<hn::ScalableTag<T>> value, T* row, int i) const {
        hn::StoreU(value, hn::ScalableTag<T>(), row + i);
    }
};

// Of each row exist first … last; a lane outside repeats the nearest of them.  The first `count` lanes are
// stored.
struct Part {
    int first, last, count;

    template <class T>
    HWY_INLINE hn::Vec<hn::ScalableTag<T>> load(const T* row, int i) const {
        HWY_ALIGN T lanes[kLanes];
        for (int lane = 0; lane < kLanes; ++lane) lanes[lane] = row[HWY_MIN(HWY_MAX(i + lane, first), last)];
        return hn::Load(hn::ScalableTag<T>(), lanes);
    }
    template <class T>
    HWY_INLINE void store(hn::Vec<hn::ScalableTag<T>> value, T* row, int i) const {
        HWY_ALIGN T lanes[kLanes];
        hn::Store(value, hn::ScalableTag<T>(), lanes);
        for (int lane = 0; lane < count; ++lane) row[i + lane] = lanes[lane];
    }
};

// Calls body(memory, i) so that every pixel i … of a row of n is covered, some twice: the last whole vector
// reaches back over the one before it.  The body looks up to `reach` pixels to both sides, at most a vector's
// length; where a row ends before (`margin`), its end pixels are repeated.
template <class Body>
HWY_INLINE void for_each_vector(int n, int reach, Margin margin, const Body& body) {
    const int first = -margin.before, last = n - 1 + margin.after;
    const int begin = HWY_MAX(0, first + reach), end = HWY_MIN(n, last + 1 - reach);
    const auto in_part = [&](int from, int to) HWY_ATTR {
        for (int i = from; i < to; i += kLanes) body(Part{first, last, HWY_MIN(kLanes, to - i)}, i);
    };
    if (end - begin < kLanes) return in_part(0, n);
    in_part(0, begin);
    for (int i = begin; i < end; i += kLanes) body(Whole(), HWY_MIN(i, end - kLanes));
    in_part(end, n);
}

// For bodies that look at their own pixel alone.
template <class Body>
HWY_INLINE void for_each_vector(int n, const Body& body) {
    for_each_vector(n, 0, {0, 0}, body);
}

}  // namespace keyline::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // the guard
