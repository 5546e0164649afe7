// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/simd/gradient.h"

#include "engine/node/node_adaptor.h"

namespace keyline {

using simd::GradientOperator;

namespace simd {

constexpr auto words(GradientOperator) {
    using enum GradientOperator;
    return std::array{Word<GradientOperator>{"central", kCentral, "[-1 0 1], not halved"},
                      Word<GradientOperator>{"sobel", kSobel, "smoothed 1 2 1 across, / 8"},
                      Word<GradientOperator>{"prewitt", kPrewitt, "smoothed 1 1 1 across, / 6"},
                      Word<GradientOperator>{"scharr", kScharr, "smoothed 3 10 3 across, / 32"}};
}

}  // namespace simd

namespace {

struct Gradient {
    static constexpr Info info{"gradient", "Slope of the image; of several channels at once, Di Zenzo's."};

    struct Params {
        Input in;
        GradientOperator op = GradientOperator::kCentral;

        static constexpr auto fields =
            declare(input(&Params::in, "in", "The image; all its channels make one gradient."),
                    field(&Params::op, "operator", "How the derivatives are taken."));
    };
    static constexpr std::array outputs{"dx", "dy", "magnitude"};

    explicit Gradient(const Params& p) : in(p.in), op(p.op) {}

    Halo halo() const { return {1, 1}; }

    static void describe(Builder&, Nature& nature) { nature.slope = true; }

    void compute(const Inputs& inputs, Outputs out, Scratch& scratch) const {
        const std::span<const View> channels = inputs[in];
        const Rect& rect = out[0].rect;
        const auto rows = scratch.take<simd::Rows3>(channels.size());
        for (int y = rect.y0; y < rect.y1; ++y) {
            for (std::size_t c = 0; c < channels.size(); ++c)
                rows[c] = simd::rows_around(channels[c], rect.x0, y);
            simd::gradient_row(op, rows, rect.width(), simd::margin_x(channels[0], rect),
                               {out[0].row(y), out[1].row(y), out[2].row(y)});
        }
    }

    const Input in;
    const GradientOperator op;
};

}  // namespace

KEYLINE_NODE(gradient, Gradient)

}  // namespace keyline
