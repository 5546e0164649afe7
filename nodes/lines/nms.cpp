// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/simd/nms.h"

#include "engine/node/node_adaptor.h"

#include <algorithm>

namespace keyline {

namespace {

struct Nms {
    static constexpr Info info{"nms", "Non-maximum suppression: thins slopes to ridges one pixel wide."};

    struct Params {
        Input in;

        static constexpr auto fields =
            declare(input(&Params::in, "in", "The slope, from gradient.", named("dx", "dy", "magnitude")));
    };
    static constexpr std::array outputs{"dx", "dy", "magnitude"};

    explicit Nms(const Params& p) : in(p.in) {}

    Halo halo() const { return {1, 1}; }
    // Nothing but what is there is kept.
    static Rect window(const std::vector<Port>& ports) { return ports[0].stream.window; }

    void compute(const Inputs& inputs, Outputs out, Scratch&) const {
        const View &dx = inputs[in][0], &dy = inputs[in][1], &magnitude = inputs[in][2];
        const Rect &rect = out[0].rect, &window = magnitude.window;
        for (int y = rect.y0; y < rect.y1; ++y) {
            const simd::GradientRow row{out[0].row(y), out[1].row(y), out[2].row(y)};
            if (y == window.y0 || y == window.y1 - 1) {
                for (float* plane : {row.dx, row.dy, row.magnitude}) std::fill_n(plane, rect.width(), 0.0F);
                continue;
            }
            simd::nms_row(simd::rows_around(magnitude, rect.x0, y), simd::rows_around(dx, rect.x0, y),
                          simd::rows_around(dy, rect.x0, y), rect.width(), simd::margin_x(magnitude, rect),
                          row);
        }
    }

    const Input in;
};

}  // namespace

KEYLINE_NODE(nms, Nms)

}  // namespace keyline
