// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/node/node_adaptor.h"
#include "engine/node/pixel_loop.h"
#include "engine/simd/color_rows.h"

#include <algorithm>
#include <fmt/format.h>

namespace keyline {

namespace {

using Rgb = std::array<double, 3>;
using Levels = std::variant<double, Rgb>;  // one number for R, G and B, or one each

double level(const Levels& levels, std::size_t channel) {
    const double* all = std::get_if<double>(&levels);
    return all ? *all : std::get<Rgb>(levels)[channel];
}

// ((in − black) ÷ (white − black) × multiply + add) ^ (1 ÷ gamma), the sign kept out of the power.
struct Grade {
    static constexpr Info info{"grade",
                               "Corrects R G B: levels, then gain, offset and gamma; A and others pass."};

    struct Params : Mixed {
        Input in;
        Levels multiply = 1.0, add = 0.0, gamma = 1.0, black = 0.0, white = 1.0;

        static constexpr auto fields = declare_mixed(
            input(&Params::in, "in", "The colour, taken as it is: premultiplied where it is.", colour())
                .leading(),
            field(&Params::multiply, "multiply", "Factor; a number, or one each for R G B, as all below."),
            field(&Params::add, "add", "What is added after multiply."),
            field(&Params::gamma, "gamma", "The result is raised to 1/gamma; its sign is kept.",
                  between(0.01, 100)),
            field(&Params::black, "black", "What becomes 0 before multiply."),
            field(&Params::white, "white", "What becomes 1 before multiply."));
    };
    static constexpr std::array outputs{"R", "G", "B"};
    static constexpr bool passes_others = true;

    static void check(const Params& p, Check& c) {
        for (std::size_t i = 0; i < 3; ++i)
            if (level(p.black, i) == level(p.white, i))
                return c.error("white", fmt::format("'black' and 'white' are both {}", level(p.white, i)),
                               "set them apart");
    }

    explicit Grade(const Params& p) : in(p.in), curves{curve(p, 0), curve(p, 1), curve(p, 2)} {}

    // A gamma makes the colour something else; what, only its author knows.
    void describe(Builder&, Nature& nature) const {
        if (std::ranges::any_of(curves, [](const Curve& c) { return c.exponent != 1; }))
            nature.colour_for = Nature::For::kUnknown;
    }

    double cost() const { return 60; }

    void compute(const Inputs& inputs, Outputs out, Scratch& scratch) const {
        for (std::size_t c = 0; c < out.size(); ++c) {
            const Curve& curve = curves[c];
            const auto line = [&](float v) {
                return static_cast<float>((double{v} - curve.black) * curve.slope + curve.add);
            };
            if (curve.exponent == 1)
                for_each_pixel(out[c], line, inputs[in][c]);
            else
                bent(out[c], inputs[in][c], line, curve.exponent, scratch);
        }
    }

private:
    // (in − black) × slope + add, to the power of exponent
    struct Curve {
        double black, slope, add, exponent;
    };

    static Curve curve(const Params& p, std::size_t c) {
        return {level(p.black, c), level(p.multiply, c) / (level(p.white, c) - level(p.black, c)),
                level(p.add, c), 1 / level(p.gamma, c)};
    }

    template <class Line>
    static void bent(const MutView& out, const View& from, const Line& line, double exponent,
                     Scratch& scratch) {
        const int n = out.rect.width();
        const MutView straight{scratch.floats(static_cast<std::size_t>(out.rect.area())).data(), n, out.rect,
                               out.window};
        for_each_pixel(straight, line, from);
        for (int y = out.rect.y0; y < out.rect.y1; ++y)
            simd::signed_power_row(straight.row(y), n, exponent, out.row(y));
    }

    const Input in;
    const std::array<Curve, 3> curves;
};

}  // namespace

KEYLINE_NODE(grade, Grade)

}  // namespace keyline
