// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/base/index.h"
#include "engine/node/node_adaptor.h"
#include "engine/simd/convolve.h"
#include "engine/simd/elementary.h"

#include <algorithm>
#include <cmath>

namespace keyline {

namespace {

// The weight at each distance from the centre.  The kernel ends at 2.5 σ, where the bell is 4 % of its
// height.
simd::Taps gaussian_taps(double sigma) {
    std::vector<double> half{1};
    const int radius = static_cast<int>(std::ceil(2.5 * sigma));
    for (int d = 1; d <= radius; ++d) half.push_back(elementary::exp(-0.5 * (d / sigma) * (d / sigma)));
    return simd::Taps(half);
}

// The input blurred in x: as many rows as one output row needs, which stay in the nearest cache.
class BlurredRows {
public:
    BlurredRows(const View& in, const Rect& out, const simd::Taps& taps, int reach, Scratch& scratch)
        : in_(in),
          out_(out),
          taps_(taps),
          reach_(reach),
          workspace_(scratch.floats(simd::row_workspace(out.width(), taps))),
          ring_(scratch.take<float*>(2 * count())),
          edge_(scratch.take<const float*>(count())),
          next_(in.rect.y0) {
        const std::size_t stride = (static_cast<std::size_t>(out.width()) + simd::kMostLanes - 1) /
                                   simd::kMostLanes * simd::kMostLanes;
        float* const rows = scratch.floats(stride * count()).data();
        for (std::size_t i = 0; i < ring_.size(); ++i) ring_[i] = rows + i % count() * stride;
    }

    // How many rows there are over and under `y`.
    simd::Margin margin(int y) const { return simd::margin_y(in_, y); }

    // Pointers to those within reach of `y`, the one returned to its own.  For one y after the other.
    const float* const* around(int y) {
        for (; next_ < std::min(y + reach_ + 1, in_.rect.y1); ++next_)
            simd::convolve_row(in_.at(out_.x0, next_), *ring_at(next_), out_.width(),
                               simd::margin_x(in_, out_), taps_, workspace_.data());
        if (y - reach_ >= in_.rect.y0 && y + reach_ < in_.rect.y1) return ring_at(y - reach_) + reach_;
        for (int k = std::max(-reach_, in_.rect.y0 - y); k <= std::min(reach_, in_.rect.y1 - 1 - y); ++k)
            edge_[index(k + reach_)] = *ring_at(y + k);
        return edge_.data() + reach_;
    }

private:
    std::size_t count() const { return 2 * static_cast<std::size_t>(reach_) + 1; }
    float* const* ring_at(int y) const {
        const int from_first = y - in_.rect.y0;
        return ring_.data() + static_cast<std::size_t>(from_first) % count();
    }

    const View& in_;
    const Rect out_;
    const simd::Taps& taps_;
    const int reach_;
    const std::span<float> workspace_;
    const std::span<float*> ring_;  // twice around, so that any row has the others after it
    const std::span<const float*> edge_;
    int next_;  // the first row that is not blurred yet
};

// Gaussian blur: a pass in x, then one in y, each channel by itself.
struct Gaussian {
    static constexpr Info info{"gaussian", "Blurs every channel with a Gaussian."};

    struct Params {
        Input in;
        Vec2 sigma = 1;

        static constexpr auto fields =
            declare(input(&Params::in, "in", "The image to blur."),
                    field(&Params::sigma, "sigma", "Standard deviation; 0 passes the image through.",
                          px(0, 500).tested_to(3)));
    };

    explicit Gaussian(const Params& p) : x(gaussian_taps(p.sigma.x)), y(gaussian_taps(p.sigma.y)) {}

    bool identity() const { return x.radius() == 0 && y.radius() == 0; }
    Halo halo() const { return {x.radius(), y.radius()}; }
    double cost() const { return 2.0 * (x.radius() + y.radius()); }

    void compute(const View& in, const MutView& out, Scratch& scratch) const {
        const int n = out.rect.width();
        BlurredRows blurred(in, out.rect, x, y.radius(), scratch);
        for (int row = out.rect.y0; row < out.rect.y1; ++row)
            simd::convolve_column(blurred.around(row), out.row(row), n, blurred.margin(row), y);
    }

    const simd::Taps x, y;
};

}  // namespace

KEYLINE_NODE(gaussian, Gaussian)

}  // namespace keyline
