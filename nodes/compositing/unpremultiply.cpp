// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/node/node_adaptor.h"
#include "engine/node/pixel_loop.h"

namespace keyline {

namespace {

// Where A is 0 nothing can be told of the colour: it becomes 0.
struct Unpremultiply {
    static constexpr Info info{"unpremultiply", "Divides R G B by A; other channels pass."};

    struct Params {
        Input in;

        static constexpr auto fields =
            declare(input(&Params::in, "in", "Colour with an A.", named("R", "G", "B", "A")));
    };
    static constexpr std::array outputs{"R", "G", "B"};
    static constexpr bool passes_others = true;

    explicit Unpremultiply(const Params& p) : in(p.in) {}

    static void describe(Builder& builder, Nature& nature) {
        if (nature.divided)
            builder.warn(Code::kDividedTwice, "R G B are divided by A already", "divide once");
        nature.divided = true;
    }

    void compute(const Inputs& inputs, Outputs out, Scratch&) const {
        const std::span<const View> rgba = inputs[in];
        for (std::size_t c = 0; c < out.size(); ++c)
            for_each_pixel(
                out[c], [](float v, float a) { return a == 0 ? 0 : v / a; }, rgba[c], rgba[3]);
    }

    const Input in;
};

}  // namespace

KEYLINE_NODE(unpremultiply, Unpremultiply)

}  // namespace keyline
