// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/node/node_adaptor.h"
#include "engine/simd/color_rows.h"

#include <algorithm>

namespace keyline {

namespace {

struct Over {
    static constexpr Info info{"over", "Lays premultiplied colour over another; other channels of bg pass."};

    struct Params {
        Input fg, bg;
        double mix = 1;
        std::optional<Input> mask;

        static constexpr auto fields =
            declare(input(&Params::fg, "fg",
                          "What lies on top; without an A it is opaque inside its data window.", colour()),
                    input(&Params::bg, "bg", "What lies below.", colour()).leading(),
                    field(&Params::mix, "mix", "How much of fg there is.", between(0, 1)),
                    input(&Params::mask, "mask", "Where fg is; nowhere outside its data window.", matte()));
    };
    static constexpr std::array outputs{"R", "G", "B", "A"};
    static constexpr bool passes_others = true;

    explicit Over(const Params& p) : fg(p.fg), bg(p.bg), mask(p.mask), mix(static_cast<float>(p.mix)) {}

    static Rect window(const std::vector<Port>& ports) {
        return unite(ports[0].stream.window, ports[1].stream.window);
    }

    void compute(const Inputs& in, Outputs out, Scratch& scratch) const {
        const Rect& rect = out[0].rect;
        const int n = rect.width();
        const std::span<const View> f = in[fg], b = in[bg], m = in[mask];
        const auto fg_alpha = scratch.floats(static_cast<std::size_t>(n)),
                   bg_alpha = scratch.floats(static_cast<std::size_t>(n));
        for (int y = rect.y0; y < rect.y1; ++y) {
            const float* alpha = alpha_row(f, y, fg_alpha);
            const simd::Coverage coverage{alpha, m.empty() ? nullptr : m[0].row(y), mix};
            for (std::size_t c = 0; c < 3; ++c)
                simd::over_row(f[c].row(y), coverage, b[c].row(y), n, out[c].row(y));
            simd::over_row(alpha, coverage, alpha_row(b, y, bg_alpha), n, out[3].row(y));
        }
    }

    const Input fg, bg;
    const std::optional<Input> mask;
    const float mix;

private:
    // The A of an input; without one, 1 inside its data window.
    static const float* alpha_row(std::span<const View> colour, int y, std::span<float> alpha) {
        if (colour.size() > 3) return colour[3].row(y);
        const View& v = colour[0];
        std::ranges::fill(alpha, 0.0F);
        const Rect inside = intersect({v.rect.x0, y, v.rect.x1, y + 1}, v.window);
        if (!inside.empty()) std::fill_n(alpha.begin() + (inside.x0 - v.rect.x0), inside.width(), 1.0F);
        return alpha.data();
    }
};

}  // namespace

KEYLINE_NODE(over, Over)

}  // namespace keyline
