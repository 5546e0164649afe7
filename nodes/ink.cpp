// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/node_adaptor.h"

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

    void compute(const Inputs& inputs, Outputs out, Scratch&) const {
        const View& matte = inputs[in][0];
        const std::span<const View> tints = tint ? inputs[*tint] : std::span<const View>{};
        const Rect& rect = out[0].rect;
        for (int y = rect.y0; y < rect.y1; ++y) {
            float* alpha = out[3].row(y);
            for (int i = 0; i < rect.width(); ++i) alpha[i] = opacity * matte.row(y)[i];
            for (std::size_t c = 0; c < 3; ++c) {
                float* to = out[c].row(y);
                for (int i = 0; i < rect.width(); ++i) to[i] = color[c] * alpha[i];
                if (tints.empty()) continue;
                const float* factor = tints[c].row(y);
                for (int i = 0; i < rect.width(); ++i) to[i] *= factor[i];
            }
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
