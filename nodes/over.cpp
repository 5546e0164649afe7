// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/node_adaptor.h"

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
        const auto n = static_cast<std::size_t>(rect.width());
        const std::span<float> amount = scratch.floats(n), fg_alpha = scratch.floats(n),
                               bg_alpha = scratch.floats(n);
        for (int y = rect.y0; y < rect.y1; ++y) {
            fill_amount(in, y, amount);
            fill_alpha(in[fg], y, fg_alpha);
            fill_alpha(in[bg], y, bg_alpha);
            for (std::size_t i = 0; i < n; ++i) fg_alpha[i] *= amount[i];
            for (std::size_t c = 0; c < 3; ++c) {
                const float *f = in[fg][c].row(y), *b = in[bg][c].row(y);
                float* o = out[c].row(y);
                for (std::size_t i = 0; i < n; ++i) o[i] = f[i] * amount[i] + b[i] * (1 - fg_alpha[i]);
            }
            for (std::size_t i = 0; i < n; ++i)
                out[3].row(y)[i] = fg_alpha[i] + bg_alpha[i] * (1 - fg_alpha[i]);
        }
    }

    const Input fg, bg;
    const std::optional<Input> mask;
    const float mix;

private:
    void fill_amount(const Inputs& in, int y, std::span<float> amount) const {
        std::ranges::fill(amount, mix);
        if (in[mask].empty()) return;
        const float* m = in[mask][0].row(y);
        for (std::size_t i = 0; i < amount.size(); ++i) amount[i] *= m[i];
    }

    // The A of an input; without one, 1 inside its data window.
    static void fill_alpha(std::span<const View> colour, int y, std::span<float> alpha) {
        if (colour.size() > 3) {
            std::copy_n(colour[3].row(y), alpha.size(), alpha.begin());
            return;
        }
        const View& v = colour[0];
        std::ranges::fill(alpha, 0.0F);
        const Rect inside = intersect({v.rect.x0, y, v.rect.x1, y + 1}, v.window);
        if (!inside.empty()) std::fill_n(alpha.begin() + (inside.x0 - v.rect.x0), inside.width(), 1.0F);
    }
};

}  // namespace

KEYLINE_NODE(over, Over)

}  // namespace keyline
