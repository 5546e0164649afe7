// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/simd/convolve.h"

#include <algorithm>

// What follows foreach_target.h is compiled once for each target.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/simd/convolve.cpp"
#include <hwy/foreach_target.h>
#include "engine/simd/rows-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace keyline::simd::HWY_NAMESPACE {

using IntTag = hn::RebindToSigned<FloatTag>;
constexpr IntTag kInt;

// Distances whose products are summed before they join the total.
constexpr int kBlock = 16;

// A radius known to the compiler unrolls the taps; 0: one that is not.
template <int kRadius>
struct Kernel {
    // Vectors computed side by side: one weight loaded serves them all, if there are registers for their
    // sums.
    static constexpr int kWide = kLanes > 8 ? 8 : 4;

    const float* weights;
    int any_radius;
    HWY_INLINE int radius() const { return kRadius > 0 ? kRadius : any_radius; }
};

// The vector at p[i], where only p[0] … p[n - 1] exist and the others count as 0.
HWY_INLINE Floats load_existing(const float* p, int i, int n) {
    if (i + kLanes <= n) return hn::LoadU(kFloat, p + i);
    HWY_ALIGN float lanes[kLanes] = {};
    for (int lane = 0; i + lane < n; ++lane) lanes[lane] = p[i + lane];
    return hn::Load(kFloat, lanes);
}

// Where the pixels under the taps are.  load(k, i) is the vector k pixels on from i, with the centre's pixel
// for each that does not exist; existing(k, i) has 0 for it.  scaled(v, i) multiplies by edge_scale().
struct Across {
    const float* in;
    HWY_INLINE Floats load(int k, int i) const { return hn::LoadU(kFloat, in + i + k); }
    HWY_INLINE Floats existing(int k, int i) const { return load(k, i); }
    HWY_INLINE Floats scaled(Floats v, int /*i*/) const { return v; }
};

// Near the row's ends: in[0] is pixel `origin`, `in` has zeros around what exists, and `scales` a factor for
// each pixel.
struct AcrossEnds {
    const float* in;
    int origin;
    int first, last;  // that exist
    const float* scales;

    HWY_INLINE Floats load(int k, int i) const {
        const auto at = hn::Iota(kInt, i + k);
        const auto exists =
            hn::And(hn::Gt(at, hn::Set(kInt, first - 1)), hn::Lt(at, hn::Set(kInt, last + 1)));
        return hn::IfThenElse(hn::RebindMask(kFloat, exists), existing(k, i), existing(0, i));
    }
    HWY_INLINE Floats existing(int k, int i) const { return hn::LoadU(kFloat, in + (i + k - origin)); }
    HWY_INLINE Floats scaled(Floats v, int i) const { return hn::Mul(v, hn::LoadU(kFloat, scales + i)); }
};

struct Down {
    const float* const* rows;
    HWY_INLINE Floats load(int k, int i) const { return hn::LoadU(kFloat, rows[k] + i); }
    HWY_INLINE Floats existing(int k, int i) const { return load(k, i); }
    HWY_INLINE Floats scaled(Floats v, int /*i*/) const { return v; }
};

// Near the first and the last row, or of n pixels that may be fewer than a vector's.
struct DownEnds {
    const float* const* rows;
    Margin margin;
    int n;
    float scale;

    HWY_INLINE Floats load(int k, int i) const {
        return load_existing(rows[k < -margin.before || k > margin.after ? 0 : k], i, n);
    }
    HWY_INLINE Floats existing(int k, int i) const {
        return k < -margin.before || k > margin.after ? hn::Zero(kFloat) : load_existing(rows[k], i, n);
    }
    HWY_INLINE Floats scaled(Floats v, int /*i*/) const { return hn::Mul(v, hn::Set(kFloat, scale)); }
};

// The convolution at i, and at the kVectors − 1 vectors right of it.
template <int kVectors, class Kernel, class Source>
HWY_INLINE void sum_taps(const Kernel& kernel, const Source& source, int i, Floats* result) {
    Floats twice[kVectors], total[kVectors];
    for (int v = 0; v < kVectors; ++v) {
        const auto centre = source.load(0, i + v * kLanes);
        twice[v] = hn::Add(centre, centre);
        total[v] = hn::Set(kFloat, -0.0F);  // which added to −0 leaves it
    }
    for (int begin = 1; begin <= kernel.radius(); begin += kBlock) {
        const int end = HWY_MIN(begin + kBlock, kernel.radius() + 1);
        const auto product = [&](int k, int v) HWY_ATTR {
            const int at = i + v * kLanes;
            const auto pair = hn::Sub(hn::Add(source.load(-k, at), source.load(k, at)), twice[v]);
            return hn::Mul(hn::Set(kFloat, kernel.weights[k]), pair);
        };
        Floats sum[kVectors];
        for (int v = 0; v < kVectors; ++v) sum[v] = product(begin, v);
        for (int k = begin + 1; k < end; ++k)
            for (int v = 0; v < kVectors; ++v) sum[v] = hn::Add(sum[v], product(k, v));
        for (int v = 0; v < kVectors; ++v) total[v] = begin == 1 ? sum[v] : hn::Add(total[v], sum[v]);
    }
    for (int v = 0; v < kVectors; ++v) {
        const int at = i + v * kLanes;
        result[v] = hn::Add(source.load(0, at), source.scaled(total[v], at));
    }
}

// The same as a plain sum of products, which takes what differences from the centre cannot: an infinite
// centre, and what is so large that a sum of two is infinite.
template <class Source>
HWY_NOINLINE Floats sum_plainly(const float* weights, int radius, const Source& source, int i) {
    auto total = hn::Mul(hn::Set(kFloat, weights[0]), source.existing(0, i));
    for (int begin = 1; begin <= radius; begin += kBlock) {
        const int end = HWY_MIN(begin + kBlock, radius + 1);
        auto before = hn::Zero(kFloat), after = hn::Zero(kFloat);
        for (int k = begin; k < end; ++k) {
            const auto weight = hn::Set(kFloat, weights[k]);
            before = hn::Add(before, hn::Mul(weight, source.existing(-k, i)));
            after = hn::Add(after, hn::Mul(weight, source.existing(k, i)));
        }
        total = hn::Add(total, hn::Add(before, after));
    }
    return with_one_nan(source.scaled(total, i));
}

constexpr int32_t kInfinityBits = 0x7F800000;  // of greater bits are only NaNs

HWY_INLINE hn::Vec<IntTag> magnitude_bits(Floats v) { return hn::BitCast(kInt, hn::Abs(v)); }

// The convolution of kVectors vectors, given to store(vector, i).
template <int kVectors, class Kernel, class Source, class Store>
HWY_INLINE void convolve_at(const Kernel& kernel, const Source& source, int i, const Store& store) {
    Floats result[kVectors];
    sum_taps<kVectors>(kernel, source, i, result);
    auto largest = magnitude_bits(result[0]);
    for (int v = 1; v < kVectors; ++v) largest = hn::Max(largest, magnitude_bits(result[v]));
    const auto infinite = hn::Set(kInt, kInfinityBits);
    if (HWY_UNLIKELY(!hn::AllTrue(kInt, hn::Lt(largest, infinite))))
        for (int v = 0; v < kVectors; ++v) {
            const auto plain = sum_plainly(kernel.weights, kernel.radius(), source, i + v * kLanes);
            const auto is_finite = hn::RebindMask(kFloat, hn::Lt(magnitude_bits(result[v]), infinite));
            result[v] = hn::IfThenElse(is_finite, result[v], plain);
        }
    for (int v = 0; v < kVectors; ++v) store(result[v], i + v * kLanes);
}

// out[0 … n), a vector or more.  The last vector may repeat pixels of the one before it.
template <class Kernel, class Source>
HWY_INLINE void convolve_vectors(const Kernel& kernel, const Source& source, float* out, int n) {
    constexpr int kWide = Kernel::kWide;
    const auto store = [&](Floats v, int at) HWY_ATTR { hn::StoreU(v, kFloat, out + at); };
    int i = 0;
    for (; i + kWide * kLanes <= n; i += kWide * kLanes) convolve_at<kWide>(kernel, source, i, store);
    for (; i < n; i += kLanes) convolve_at<1>(kernel, source, HWY_MIN(i, n - kLanes), store);
}

// out[begin … end) where vectors may reach beyond.
template <class Source>
HWY_INLINE void convolve_part(const Kernel<0>& kernel, const Source& source, float* out, int begin, int end) {
    for (int i = begin; i < end; i += kLanes)
        convolve_at<1>(kernel, source, i, [&](Floats v, int at) HWY_ATTR {
            HWY_ALIGN float lanes[kLanes];
            hn::Store(v, kFloat, lanes);
            for (int lane = 0; at + lane < HWY_MIN(at + kLanes, end); ++lane) out[at + lane] = lanes[lane];
        });
}

// For a row whose pixels under all taps can be read.
template <class Source>
HWY_INLINE void convolve_whole(const float* weights, int radius, const Source& source, float* out, int n) {
    switch (radius) {
        case 1: return convolve_vectors(Kernel<1>{weights, radius}, source, out, n);
        case 2: return convolve_vectors(Kernel<2>{weights, radius}, source, out, n);
        case 3: return convolve_vectors(Kernel<3>{weights, radius}, source, out, n);
        case 4: return convolve_vectors(Kernel<4>{weights, radius}, source, out, n);
        case 5: return convolve_vectors(Kernel<5>{weights, radius}, source, out, n);
        default: return convolve_vectors(Kernel<0>{weights, radius}, source, out, n);
    }
}

// out[begin … end), of a row of n, where taps may reach beyond its ends.
void convolve_end(const float* in, float* out, int begin, int end, int n, Margin margin, const float* weights,
                  int radius, const RowEnds& ends) {
    if (begin == end) return;
    const int from = begin - radius, to = end + kLanes + radius;
    const int first = HWY_MAX(from, -margin.before), last = HWY_MIN(to, n + margin.after);
    float* padded = std::fill_n(ends.padded, first - from, 0.0F);
    padded = std::copy_n(in + first, last - first, padded);
    std::fill_n(padded, to - last, 0.0F);
    const AcrossEnds source{ends.padded, from, -margin.before, n - 1 + margin.after, ends.scales};
    convolve_part({weights, radius}, source, out, begin, end);
}

void sum_across(const float* in, float* out, int n, Margin margin, const float* weights, int radius,
                const RowEnds& ends) {
    const int whole = ends.right - ends.left;
    if (whole < kLanes) return convolve_end(in, out, 0, n, n, margin, weights, radius, ends);
    convolve_end(in, out, 0, ends.left, n, margin, weights, radius, ends);
    convolve_whole(weights, radius, Across{in + ends.left}, out + ends.left, whole);
    convolve_end(in, out, ends.right, n, n, margin, weights, radius, ends);
}

void sum_down(const float* const* rows, float* out, int n, const float* weights, int radius, Margin margin,
              float scale) {
    const bool whole = margin.before >= radius && margin.after >= radius;
    const DownEnds source{rows, margin, n, scale};
    if (n < kLanes)
        convolve_part({weights, radius}, source, out, 0, n);
    else if (whole)
        convolve_whole(weights, radius, Down{rows}, out, n);
    else
        convolve_vectors(Kernel<0>{weights, radius}, source, out, n);
}

}  // namespace keyline::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace keyline::simd {

HWY_EXPORT(sum_across);
HWY_EXPORT(sum_down);

Taps::Taps(const std::vector<double>& half) {
    double sum = half[0];
    for (std::size_t d = 1; d < half.size(); ++d) sum += 2 * half[d];
    double within = 0;
    for (const double weight : half) {
        weights_.push_back(static_cast<float>(weight / sum));
        within_.push_back(within += weight / sum);
    }
}

float Taps::edge_scale(Margin margin) const {
    const int before = std::min(margin.before, radius()), after = std::min(margin.after, radius());
    const double present =
        within_[static_cast<std::size_t>(before)] + within_[static_cast<std::size_t>(after)];
    return static_cast<float>(1 / (present - within_[0]));
}

void convolve_row(const float* in, float* out, int n, Margin margin, const Taps& taps, float* workspace) {
    const int left = std::clamp(taps.radius() - margin.before, 0, n);
    const int right = std::clamp(n - (taps.radius() - margin.after), left, n);
    float* const scales = workspace;
    float* const padded = workspace + n + kMostLanes;
    const auto find_scales = [&](int begin, int end) {
        for (int i = begin; i < end; ++i)
            scales[i] = taps.edge_scale({margin.before + i, margin.after + n - 1 - i});
        std::fill_n(scales + end, kMostLanes, 1.0F);  // of the rest of a vector
    };
    if (right - left < static_cast<int>(kMostLanes)) {
        find_scales(0, n);
    } else {
        if (left > 0) find_scales(0, left);
        if (right < n) find_scales(right, n);
    }
    HWY_DYNAMIC_DISPATCH(sum_across)
    (in, out, n, margin, taps.weights(), taps.radius(), {left, right, scales, padded});
}

void convolve_column(const float* const* rows, float* out, int n, Margin margin, const Taps& taps) {
    HWY_DYNAMIC_DISPATCH(sum_down)
    (rows, out, n, taps.weights(), taps.radius(), margin, taps.edge_scale(margin));
}

}  // namespace keyline::simd
#endif  // HWY_ONCE
