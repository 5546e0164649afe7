// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/simd/convolve.h"

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

// Vectors computed side by side, so that one weight loaded serves them all.
constexpr int kWide = 4;

struct Kernel {
    const float* weights;
    int radius;
};

// The vector at p[i], where only p[first] … p[last] exist and the others count as 0.
HWY_INLINE Floats load_existing(const float* p, int i, int first, int last) {
    if (i >= first && i + kLanes - 1 <= last) return hn::LoadU(kFloat, p + i);
    HWY_ALIGN float lanes[kLanes] = {};
    for (int lane = HWY_MAX(first - i, 0); lane < kLanes && i + lane <= last; ++lane)
        lanes[lane] = p[i + lane];
    return hn::Load(kFloat, lanes);
}

// Where the pixels under the taps are: load(k, i) is the vector k pixels on from i.
struct Across {
    const float* in;
    HWY_INLINE Floats load(int k, int i) const { return hn::LoadU(kFloat, in + i + k); }
};

struct AcrossClipped {
    const float* in;
    int first, last;
    HWY_INLINE Floats load(int k, int i) const { return load_existing(in, i + k, first, last); }
};

struct Down {
    const float* in;
    std::ptrdiff_t stride;
    HWY_INLINE Floats load(int k, int i) const { return hn::LoadU(kFloat, in + k * stride + i); }
};

struct DownClipped {
    const float* in;
    std::ptrdiff_t stride;
    int n;
    Margin margin;
    HWY_INLINE Floats load(int k, int i) const {
        if (k < -margin.before || k > margin.after) return hn::Zero(kFloat);
        return load_existing(in + k * stride, i, 0, n - 1);
    }
};

// The convolution at i, and at the kVectors − 1 vectors right of it.
template <int kVectors, class Source>
HWY_INLINE void sum_taps(const Kernel& kernel, const Source& source, int i, Floats* total) {
    const auto centre = hn::Set(kFloat, kernel.weights[0]);
    for (int v = 0; v < kVectors; ++v) total[v] = hn::Mul(centre, source.load(0, i + v * kLanes));
    for (int begin = 1; begin <= kernel.radius; begin += kBlock) {
        const int end = HWY_MIN(begin + kBlock, kernel.radius + 1);
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

// out[begin … end), a vector or more.  The last vector may repeat pixels of the one before it.
template <class Source>
HWY_INLINE void convolve_vectors(const Kernel& kernel, const Source& source, float* out, int begin, int end) {
    int i = begin;
    for (; i + kWide * kLanes <= end; i += kWide * kLanes) {
        Floats total[kWide];
        sum_taps<kWide>(kernel, source, i, total);
        for (int v = 0; v < kWide; ++v) hn::StoreU(with_one_nan(total[v]), kFloat, out + i + v * kLanes);
    }
    for (; i < end; i += kLanes) {
        i = HWY_MIN(i, end - kLanes);
        Floats total[1];
        sum_taps<1>(kernel, source, i, total);
        hn::StoreU(with_one_nan(total[0]), kFloat, out + i);
    }
}

// out[begin … end), any number, for a source that knows what exists.
template <class Source>
HWY_INLINE void convolve_few(const Kernel& kernel, const Source& source, float* out, int begin, int end) {
    for (int i = begin; i < end; i += kLanes) {
        Floats total[1];
        sum_taps<1>(kernel, source, i, total);
        HWY_ALIGN float lanes[kLanes];
        hn::Store(with_one_nan(total[0]), kFloat, lanes);
        for (int lane = 0; lane < kLanes && i + lane < end; ++lane) out[i + lane] = lanes[lane];
    }
}

void sum_across(const float* in, float* out, int n, Margin margin, const float* weights, int radius) {
    const Kernel kernel{weights, radius};
    const AcrossClipped clipped{in, -margin.before, n - 1 + margin.after};
    const int begin = HWY_MAX(0, radius - margin.before), end = n - HWY_MAX(0, radius - margin.after);
    if (end - begin < kLanes) return convolve_few(kernel, clipped, out, 0, n);
    convolve_few(kernel, clipped, out, 0, begin);
    convolve_vectors(kernel, Across{in}, out, begin, end);
    convolve_few(kernel, clipped, out, end, n);
}

void sum_down(const float* in, std::ptrdiff_t stride, float* out, int n, Margin margin, const float* weights,
              int radius) {
    const Kernel kernel{weights, radius};
    const DownClipped clipped{in, stride, n, margin};
    if (n < kLanes)
        convolve_few(kernel, clipped, out, 0, n);
    else if (margin.before < radius || margin.after < radius)
        convolve_vectors(kernel, clipped, out, 0, n);
    else
        convolve_vectors(kernel, Down{in, stride}, out, 0, n);
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

void convolve_row(const float* in, float* out, int n, Margin margin, const Taps& taps) {
    HWY_DYNAMIC_DISPATCH(sum_across)(in, out, n, margin, taps.weights(), taps.radius());
    const int left = std::clamp(taps.radius() - margin.before, 0, n);
    const int right = std::clamp(n - (taps.radius() - margin.after), left, n);
    const auto rescale = [&](int i) {
        out[i] *= taps.edge_scale({margin.before + i, margin.after + n - 1 - i});
    };
    for (int i = 0; i < left; ++i) rescale(i);
    for (int i = right; i < n; ++i) rescale(i);
}

void convolve_column(const float* in, std::ptrdiff_t stride, float* out, int n, Margin margin,
                     const Taps& taps) {
    HWY_DYNAMIC_DISPATCH(sum_down)(in, stride, out, n, margin, taps.weights(), taps.radius());
    if (margin.before >= taps.radius() && margin.after >= taps.radius()) return;
    const float scale = taps.edge_scale(margin);
    for (int i = 0; i < n; ++i) out[i] *= scale;
}

void convolve_x(const View& in, const MutView& out, const Taps& taps) {
    for (int y = out.rect.y0; y < out.rect.y1; ++y)
        convolve_row(in.at(out.rect.x0, y), out.row(y), out.rect.width(), margin_x(in, out.rect), taps);
}

void convolve_y(const View& in, const MutView& out, const Taps& taps) {
    for (int y = out.rect.y0; y < out.rect.y1; ++y)
        convolve_column(in.at(out.rect.x0, y), in.stride, out.row(y), out.rect.width(), margin_y(in, y),
                        taps);
}

}  // namespace keyline::simd
#endif  // HWY_ONCE
