// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/node_adaptor.h"
#include "engine/simd/convolve.h"
#include "engine/simd/elementary.h"

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
        const Rect rows{out.rect.x0, in.rect.y0, out.rect.x1, in.rect.y1};
        const std::ptrdiff_t stride = rows.width();
        const MutView blurred{scratch.floats(static_cast<std::size_t>(rows.area())).data(), stride, rows,
                              in.window};
        simd::convolve_x(in, blurred, x);
        simd::convolve_y(blurred, out, y);
    }

    const simd::Taps x, y;
};

}  // namespace

KEYLINE_NODE(gaussian, Gaussian)

}  // namespace keyline
