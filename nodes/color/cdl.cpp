// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/color_operation.h"
#include "engine/node/node_adaptor.h"

namespace keyline {

namespace {

struct Cdl {
    static constexpr Info info{"cdl",
                               "A colour decision: (R G B × slope + offset) ^ power, then the saturation; "
                               "'lut' takes one from a file."};

    struct Params {
        Input in;
        std::array<double, 3> slope{1, 1, 1}, offset{}, power{1, 1, 1};
        double saturation = 1;
        bool inverse = false;

        static constexpr auto fields = declare(
            input(&Params::in, "in", "The image, in the space that the decision is for; other channels pass.",
                  colour()),
            field(&Params::slope, "slope", "What R, G and B are multiplied by.", at_least(0).tested_to(4)),
            field(&Params::offset, "offset", "What is added to them then.", between(-100, 100).tested_to(1)),
            field(&Params::power, "power",
                  "And the power that they are raised to; what is below 0 stays as it is.",
                  between(0.01, 100).tested_to(4)),
            field(&Params::saturation, "saturation",
                  "Of what that gives, by Rec. 709's weights: 0 is grey, 1 leaves it.",
                  at_least(0).tested_to(4)),
            field(&Params::inverse, "inverse", "Whether to take the decision back."));
    };

    static void check(const Params& p, Check& c) {
        if (p.inverse && (p.slope[0] * p.slope[1] * p.slope[2] == 0 || p.saturation == 0))
            c.error("inverse", "a slope or a saturation of 0 can't be taken back");
    }

    explicit Cdl(const Params& p) : params(p) {}

    Stream expand(Builder& builder) const {
        const Stream in = builder.input(params.in);
        const Nature::For kept = in.nature_of_colour().colour_for;
        return convert_colour(
            builder, in,
            builder.colors().decide({params.slope, params.offset, params.power, params.saturation},
                                    params.inverse),
            {kept, kept});
    }

    const Params params;
};

}  // namespace

KEYLINE_NODE(cdl, Cdl)

}  // namespace keyline
