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

using DoubleTag = hn::ScalableTag<double>;
using Doubles = hn::Vec<DoubleTag>;
constexpr DoubleTag kDouble;

// As many floats as there are doubles in a vector.
constexpr hn::Rebind<float, DoubleTag> kFewFloats;
using FewFloats = hn::Vec<decltype(kFewFloats)>;

// To float, with one NaN.  Highway's portable conversion ends at the largest float where the others go on to
// infinity, so the largest counts as infinite everywhere.
HWY_INLINE FewFloats rounded(Doubles v) {
    const auto f = hn::DemoteTo(kFewFloats, v);
    const auto largest = hn::Set(kFewFloats, std::numeric_limits<float>::max());
    const auto infinity = hn::Set(kFewFloats, std::numeric_limits<float>::infinity());
    const auto nan = hn::Set(kFewFloats, std::numeric_limits<float>::quiet_NaN());
    const auto extended = hn::IfThenElse(hn::Ge(hn::Abs(f), largest), hn::CopySign(infinity, f), f);
    return hn::IfThenElse(hn::IsNaN(f), nan, extended);
}

struct Whole {
    // Of a row that has a margin.
    template <class D, class T>
    HWY_INLINE hn::Vec<D> load(D d, const T* row, int i) const {
        return hn::LoadU(d, row + i);
    }
    // Of a row that ends where the output does.
    template <class D, class T>
    HWY_INLINE hn::Vec<D> load_own(D d, const T* row, int i) const {
        return hn::LoadU(d, row + i);
    }
    template <class D, class T>
    HWY_INLINE void store(hn::Vec<D> value, D d, T* row, int i) const {
        hn::StoreU(value, d, row + i);
    }
};

// Of each row exist first … last; a lane outside repeats the nearest of them.  The first `count` lanes are
// stored.
class Part {
public:
    HWY_INLINE Part(int first, int last, int count) : first_(first), last_(last), count_(count) {}

    template <class D, class T>
    HWY_INLINE hn::Vec<D> load(D d, const T* row, int i) const {
        return load_clamped(d, row, i, last_);
    }
    template <class D, class T>
    HWY_INLINE hn::Vec<D> load_own(D d, const T* row, int i) const {
        return load_clamped(d, row, i, i + count_ - 1);
    }
    template <class D, class T>
    HWY_INLINE void store(hn::Vec<D> value, D d, T* row, int i) const {
        HWY_ALIGN T lanes[hn::MaxLanes(D())];
        hn::Store(value, d, lanes);
        for (int lane = 0; lane < count_; ++lane) row[i + lane] = lanes[lane];
    }

private:
    template <class D, class T>
    HWY_INLINE hn::Vec<D> load_clamped(D d, const T* row, int i, int end) const {
        constexpr int kCount = static_cast<int>(hn::MaxLanes(D()));
        HWY_ALIGN T lanes[kCount];
        for (int lane = 0; lane < kCount; ++lane) lanes[lane] = row[HWY_MIN(HWY_MAX(i + lane, first_), end)];
        return hn::Load(d, lanes);
    }

    int first_, last_, count_;
};

// Calls body(memory, i) for vectors of D at i = …, so that every pixel of a row of n is covered, some twice:
// the last whole vector reaches back over the one before it.  The body looks up to `reach` pixels to both
// sides, at most a vector's length; where the row ends before (`margin`), its end pixels are repeated.
template <class D, class Body>
HWY_INLINE void for_each_vector(D, int n, int reach, Margin margin, const Body& body) {
    constexpr int kCount = static_cast<int>(hn::MaxLanes(D()));
    const int first = -margin.before, last = n - 1 + margin.after;
    const int begin = HWY_MAX(0, first + reach), end = HWY_MIN(n, last + 1 - reach);
    const auto in_part = [&](int from, int to) HWY_ATTR {
        for (int i = from; i < to; i += kCount) body(Part{first, last, HWY_MIN(kCount, to - i)}, i);
    };
    if (end - begin < kCount) return in_part(0, n);
    in_part(0, begin);
    for (int i = begin; i < end; i += kCount) body(Whole(), HWY_MIN(i, end - kCount));
    in_part(end, n);
}

// For bodies that look at their own pixel alone.
template <class D, class Body>
HWY_INLINE void for_each_vector(D d, int n, const Body& body) {
    for_each_vector(d, n, 0, {0, 0}, body);
}

}  // namespace keyline::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // the guard
