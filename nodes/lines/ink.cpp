// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/node/node_adaptor.h"
#include "engine/node/pixel_loop.h"

namespace keyline {

namespace {

struct Ink {
    static constexpr Info info{"ink", "Colour where a matte is: lines from edges."};

    struct Params {
        Input in;
        Color color;
        double opacity = 1;
        std::optional<Input> tint;

        static constexpr auto fields = declare(
            input(&Params::in, "in", "Where the ink goes.", matte()),
            field(&Params::color, "color", "The ink, scene-linear, or sRGB as \"#rrggbb\"."),
            field(&Params::opacity, "opacity", "How much of what is below it covers.", between(0, 1)),
            input(&Params::tint, "tint",
                  "Multiplied into the colour: an albedo, so that lines take after their object.", colour()));
    };
    static constexpr std::array outputs{"R", "G", "B", "A"};

    explicit Ink(const Params& p)
        : in(p.in),
          color{static_cast<float>(p.color.r), static_cast<float>(p.color.g), static_cast<float>(p.color.b)},
          opacity(static_cast<float>(p.opacity)),
          tint(p.tint) {}

    // Where there is no matte there is no ink.
    static Rect window(const std::vector<Port>& ports) { return ports[0].stream.window; }

    void compute(const Inputs& inputs, Outputs out, Scratch&) const {
        const View& matte = inputs[in][0];
        const std::span<const View> tints = tint ? inputs[*tint] : std::span<const View>{};
        const float o = opacity;
        for_each_pixel(
            out[3], [o](float m) { return o * m; }, matte);
        for (std::size_t c = 0; c < 3; ++c) {
            const float k = color[c];
            if (tints.empty())
                for_each_pixel(
                    out[c], [o, k](float m) { return k * (o * m); }, matte);
            else
                for_each_pixel(
                    out[c], [o, k](float m, float t) { return k * (o * m) * t; }, matte, tints[c]);
        }
    }

    const Input in;
    const std::array<float, 3> color;
    const float opacity;
    const std::optional<Input> tint;
};

}  // namespace

KEYLINE_NODE(ink, Ink)

}  // namespace keyline
