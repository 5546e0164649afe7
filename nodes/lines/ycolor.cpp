// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/node/node_adaptor.h"
#include "engine/simd/color_rows.h"

namespace keyline {

namespace {

enum class Weights { kNtsc, kRec709, kAcescg };

constexpr auto words(Weights) {
    return std::array{Word<Weights>{"ntsc", Weights::kNtsc, "0.299 0.587 0.114"},
                      Word<Weights>{"rec709", Weights::kRec709, "0.2126 0.7152 0.0722"},
                      Word<Weights>{"acescg", Weights::kAcescg, "0.2722287 0.6740818 0.0536895"}};
}

// Grey as the eye weighs it, of premultiplied colour: nothing is divided by A.
struct YColor {
    static constexpr Info info{"ycolor", "The grey, Y, of colour."};

    using Numbers = std::array<double, 3>;
    struct Params {
        Input in;
        std::variant<Weights, Numbers> weights;
        bool clamp = false;
        double gamma = 1;

        static constexpr auto fields = declare(
            input(&Params::in, "in", "The colour.", colour_without_alpha()),
            field(&Params::weights, "weights", "What R, G and B count."),
            field(&Params::clamp, "clamp", "Limit Y to 0 … 1, before gamma."),
            field(&Params::gamma, "gamma", "Y is raised to 1/gamma; its sign is kept.", between(0.01, 100)));
    };
    static constexpr std::array outputs{"Y"};

    explicit YColor(const Params& p)
        : in(p.in), weights(to_float(p.weights)), clamp(p.clamp), exponent(1 / p.gamma) {}

    double cost() const { return exponent == 1 ? 5 : 60; }

    void compute(const Inputs& inputs, Outputs out, Scratch& scratch) const {
        const std::span<const View> rgb = inputs[in];
        const int n = out[0].rect.width();
        const bool curved = exponent != 1;
        float* grey = scratch.floats(static_cast<std::size_t>(n)).data();
        float* clamped = scratch.floats(static_cast<std::size_t>(n)).data();
        for (int y = out[0].rect.y0; y < out[0].rect.y1; ++y) {
            float* row = out[0].row(y);
            float* weighted = clamp || curved ? grey : row;
            simd::weighted_rgb_row({rgb[0].row(y), rgb[1].row(y), rgb[2].row(y)}, weights, n, weighted);
            if (clamp) simd::clamp_row(weighted, n, curved ? clamped : row);
            if (curved) simd::signed_power_row(clamp ? clamped : weighted, n, exponent, row);
        }
    }

    const Input in;
    const std::array<float, 3> weights;
    const bool clamp;
    const double exponent;

private:
    static std::array<float, 3> to_float(const std::variant<Weights, Numbers>& weights) {
        const Weights* word = std::get_if<Weights>(&weights);
        const Numbers n = !word                       ? std::get<Numbers>(weights)
                          : *word == Weights::kNtsc   ? Numbers{0.299, 0.587, 0.114}
                          : *word == Weights::kRec709 ? Numbers{0.2126, 0.7152, 0.0722}
                                                      : Numbers{0.2722287, 0.6740818, 0.0536895};
        return {static_cast<float>(n[0]), static_cast<float>(n[1]), static_cast<float>(n[2])};
    }
};

}  // namespace

KEYLINE_NODE(ycolor, YColor)

}  // namespace keyline
