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

// Distances whose products are summed before they join the total.
constexpr int kBlock = 16;

// A radius known to the compiler unrolls the taps; 0: one that is not.
template <int kRadius>
struct Kernel {
    // Vectors computed side by side: one weight loaded serves them all, if there are registers for their
    // sums.
    static constexpr int kWide = kRadius > 0 ? 8 : 4;

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

// Where the pixels under the taps are: load(k, i) is the vector k pixels on from i.
struct Across {
    const float* in;
    HWY_INLINE Floats load(int k, int i) const { return hn::LoadU(kFloat, in + i + k); }
};

struct Down {
    const float* const* rows;
    HWY_INLINE Floats load(int k, int i) const { return hn::LoadU(kFloat, rows[k] + i); }
};

struct DownClipped {
    const float* const* rows;
    int n;
    HWY_INLINE Floats load(int k, int i) const {
        return rows[k] == nullptr ? hn::Zero(kFloat) : load_existing(rows[k], i, n);
    }
};

// The convolution at i, and at the kVectors − 1 vectors right of it.
template <int kVectors, class Kernel, class Source>
HWY_INLINE void sum_taps(const Kernel& kernel, const Source& source, int i, Floats* total) {
    const auto centre = hn::Set(kFloat, kernel.weights[0]);
    for (int v = 0; v < kVectors; ++v) total[v] = hn::Mul(centre, source.load(0, i + v * kLanes));
    for (int begin = 1; begin <= kernel.radius(); begin += kBlock) {
        const int end = HWY_MIN(begin + kBlock, kernel.radius() + 1);
        Floats before[kVectors], after[kVectors];
        const auto first = hn::Set(kFloat, kernel.weights[begin]);
        for (int v = 0; v < kVectors; ++v) {
            before[v] = hn::Mul(first, source.load(-begin, i + v * kLanes));
            after[v] = hn::Mul(first, source.load(begin, i + v * kLanes));
        }
        for (int k = begin + 1; k < end; ++k) {
            const auto weight = hn::Set(kFloat, kernel.weights[k]);
            for (int v = 0; v < kVectors; ++v) {
                before[v] = hn::Add(before[v], hn::Mul(weight, source.load(-k, i + v * kLanes)));
                after[v] = hn::Add(after[v], hn::Mul(weight, source.load(k, i + v * kLanes)));
            }
        }
        for (int v = 0; v < kVectors; ++v) total[v] = hn::Add(total[v], hn::Add(before[v], after[v]));
    }
}

// out[0 … n), a vector or more.  The last vector may repeat pixels of the one before it.
template <class Kernel, class Source>
HWY_INLINE void convolve_vectors(const Kernel& kernel, const Source& source, float* out, int n) {
    constexpr int kWide = Kernel::kWide;
    int i = 0;
    for (; i + kWide * kLanes <= n; i += kWide * kLanes) {
        Floats total[kWide];
        sum_taps<kWide>(kernel, source, i, total);
        for (int v = 0; v < kWide; ++v) hn::StoreU(with_one_nan(total[v]), kFloat, out + i + v * kLanes);
    }
    for (; i < n; i += kLanes) {
        i = HWY_MIN(i, n - kLanes);
        Floats total[1];
        sum_taps<1>(kernel, source, i, total);
        hn::StoreU(with_one_nan(total[0]), kFloat, out + i);
    }
}

// Less than a vector.
template <class Source>
HWY_INLINE void convolve_few(const Kernel<0>& kernel, const Source& source, float* out, int n) {
    Floats total[1];
    sum_taps<1>(kernel, source, 0, total);
    HWY_ALIGN float lanes[kLanes];
    hn::Store(with_one_nan(total[0]), kFloat, lanes);
    for (int lane = 0; lane < n; ++lane) out[lane] = lanes[lane];
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

void sum_across(const float* in, float* out, int n, Margin margin, const float* weights, int radius,
                float* padded) {
    if (n >= kLanes && margin.before >= radius && margin.after >= radius)
        return convolve_whole(weights, radius, Across{in}, out, n);
    const int before = HWY_MIN(margin.before, radius), existing = before + n + HWY_MIN(margin.after, radius);
    std::fill_n(padded, n + 2 * radius + kLanes, 0.0F);
    std::copy_n(in - before, existing, padded + radius - before);
    if (n >= kLanes)
        convolve_whole(weights, radius, Across{padded + radius}, out, n);
    else
        convolve_few({weights, radius}, Across{padded + radius}, out, n);
}

void sum_down(const float* const* rows, float* out, int n, const float* weights, int radius, bool whole) {
    if (n < kLanes)
        convolve_few({weights, radius}, DownClipped{rows, n}, out, n);
    else if (whole)
        convolve_whole(weights, radius, Down{rows}, out, n);
    else
        convolve_vectors(Kernel<0>{weights, radius}, DownClipped{rows, n}, out, n);
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

void convolve_row(const float* in, float* out, int n, Margin margin, const Taps& taps, float* padded) {
    HWY_DYNAMIC_DISPATCH(sum_across)(in, out, n, margin, taps.weights(), taps.radius(), padded);
    const int left = std::clamp(taps.radius() - margin.before, 0, n);
    const int right = std::clamp(n - (taps.radius() - margin.after), left, n);
    const auto rescale = [&](int i) {
        out[i] *= taps.edge_scale({margin.before + i, margin.after + n - 1 - i});
    };
    for (int i = 0; i < left; ++i) rescale(i);
    for (int i = right; i < n; ++i) rescale(i);
}

void convolve_column(const float* const* rows, float* out, int n, const Taps& taps) {
    Margin margin{taps.radius(), taps.radius()};
    while (margin.before > 0 && rows[-margin.before] == nullptr) --margin.before;
    while (margin.after > 0 && rows[margin.after] == nullptr) --margin.after;
    const bool whole = margin.before == taps.radius() && margin.after == taps.radius();
    HWY_DYNAMIC_DISPATCH(sum_down)(rows, out, n, taps.weights(), taps.radius(), whole);
    if (whole) return;
    const float scale = taps.edge_scale(margin);
    for (int i = 0; i < n; ++i) out[i] *= scale;
}

}  // namespace keyline::simd
#endif  // HWY_ONCE
