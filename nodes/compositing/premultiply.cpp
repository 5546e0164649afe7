// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/node/node_adaptor.h"
#include "engine/node/pixel_loop.h"

namespace keyline {

namespace {

struct Premultiply {
    static constexpr Info info{"premultiply", "Multiplies R G B by A; other channels pass."};

    struct Params {
        Input in;

        static constexpr auto fields =
            declare(input(&Params::in, "in", "Colour with an A.", named("R", "G", "B", "A")));
    };
    static constexpr std::array outputs{"R", "G", "B"};
    static constexpr bool passes_others = true;

    explicit Premultiply(const Params& p) : in(p.in) {}

    static void describe(Builder&, Nature& nature) { nature.divided = false; }

    void compute(const Inputs& inputs, Outputs out, Scratch&) const {
        const std::span<const View> rgba = inputs[in];
        for (std::size_t c = 0; c < out.size(); ++c)
            for_each_pixel(
                out[c], [](float v, float a) { return v * a; }, rgba[c], rgba[3]);
    }

    const Input in;
};

}  // namespace

KEYLINE_NODE(premultiply, Premultiply)

}  // namespace keyline
