// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/node/node_adaptor.h"
#include "engine/node/pixel_loop.h"

#include <algorithm>
#include <cmath>

namespace keyline {

namespace {

// 1 / depth is linear on every plane, however it lies.  So what a pixel's neighbours differ by beyond what
// the surfaces on either side go on with is a step from one to another: a floor that runs away has none, a
// crease neither, as there both sides say opposite things.
struct PlaneStep {
    static constexpr Info info{
        "planestep", "Steps in depth that no surface explains: where one part stands before another."};

    struct Params {
        Input in;

        static constexpr auto fields = declare(
            input(&Params::in, "in",
                  "The depth, one sample a pixel, not averaged; 0 and less is infinitely far.", matte("Z")));
    };
    // Slope of nearness, as a share of the nearer one: 0.01 is a centimetre at a metre, 1 nothing behind.
    static constexpr std::array outputs{"dx", "dy", "magnitude"};

    explicit PlaneStep(const Params& p) : in(p.in) {}

    static Halo halo() { return {2, 2}; }

    void compute(const Inputs& inputs, Outputs out, Scratch&) const {
        const View& depth = inputs[in][0];
        const Rect& rect = out[0].rect;
        for (int y = rect.y0; y < rect.y1; ++y)
            for (int x = rect.x0; x < rect.x1; ++x) {
                const double dx = step(depth, x, y, 1, 0), dy = step(depth, x, y, 0, 1);
                *out[0].at(x, y) = with_one_nan(static_cast<float>(dx));
                *out[1].at(x, y) = with_one_nan(static_cast<float>(dy));
                *out[2].at(x, y) = with_one_nan(static_cast<float>(std::sqrt(dx * dx + dy * dy)));
            }
    }

    const Input in;

private:
    static double nearness(const View& depth, int x, int y) {
        const double z = *depth.at(x, y);
        return z <= 0 ? 0 : 1 / z;
    }

    // Along one axis.  At the rim of the picture nobody knows both surfaces.
    static double step(const View& depth, int x, int y, int u, int v) {
        if (!depth.rect.contains(x - 2 * u, y - 2 * v) || !depth.rect.contains(x + 2 * u, y + 2 * v))
            return 0;
        const auto at = [&](int i) { return nearness(depth, x + i * u, y + i * v); };
        const double before = at(-1), behind = at(1), difference = behind - before;
        const double by_first = difference - 2 * (before - at(-2));
        const double by_second = difference - 2 * (at(2) - behind);
        const double both = by_first * by_second;
        if (both != both) return both;
        if (!(both > 0)) return 0;
        const double step = std::fabs(by_first) < std::fabs(by_second) ? by_first : by_second;
        return step / std::max(before, behind);
    }
};

}  // namespace

KEYLINE_NODE(planestep, PlaneStep)

}  // namespace keyline
