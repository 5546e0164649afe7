// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/node/node_adaptor.h"
#include "engine/node/pixel_loop.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace keyline {

namespace {

// Both sides of an edge have the colour of what is in front.
struct Nearer {
    static constexpr Info info{"nearer",
                               "The colour of what is nearest around each pixel: the tint of lines that take "
                               "after their object, on both sides of its edge."};

    struct Params {
        Input in, depth;
        int radius = 2;

        static constexpr auto fields =
            declare(input(&Params::in, "in", "The image, as an albedo.", colour_without_alpha()),
                    input(&Params::depth, "depth",
                          "Where things are nearer, smaller; 0 and less is infinitely far.", matte("Z")),
                    field(&Params::radius, "radius",
                          "How far around to look, in pixels: the width of the lines.", between(0, 16)));
    };
    static constexpr std::array outputs{"R", "G", "B"};

    explicit Nearer(const Params& p) : params(p) {}

    Halo halo() const { return {params.radius, params.radius}; }
    double cost() const { return 8.0 * params.radius; }

    void compute(const Inputs& in, Outputs out, Scratch& scratch) const {
        const View& depth = in[params.depth][0];
        const Rect& rect = out[0].rect;
        const Rect around = intersect(grow(rect, halo()), depth.rect);
        const auto width = index(rect.width());
        const Nearest rows = nearest_in_rows(depth, rect, around, scratch);
        for (int y = rect.y0; y < rect.y1; ++y)
            for (int x = rect.x0; x < rect.x1; ++x) {
                int from_x = x, from_y = y;
                float least = std::numeric_limits<float>::infinity();
                const auto look_at = [&](int row) {
                    if (row < around.y0 || row >= around.y1) return;
                    const std::size_t i = index(row - around.y0) * width + index(x - rect.x0);
                    if (!(rows.depth[i] < least)) return;
                    least = rows.depth[i];
                    from_x = x + rows.aside[i];
                    from_y = row;
                };
                look_at(y);
                for (int k = 1; k <= params.radius; ++k) {
                    look_at(y - k);
                    look_at(y + k);
                }
                take(in[params.in], from_x, from_y, out, x, y);
            }
    }

    const Params params;

private:
    // Of each pixel of a row, among those beside it: how near it is, and where.
    struct Nearest {
        std::span<float> depth;
        std::span<int8_t> aside;
    };

    Nearest nearest_in_rows(const View& depth, const Rect& rect, const Rect& around, Scratch& scratch) const {
        const std::size_t count = index(around.height()) * index(rect.width());
        const Nearest out{scratch.floats(count), scratch.take<int8_t>(count)};
        std::size_t i = 0;
        for (int y = around.y0; y < around.y1; ++y)
            for (int x = rect.x0; x < rect.x1; ++x, ++i) {
                out.depth[i] = far_at(depth, x, y);
                out.aside[i] = 0;
                for (int k = 1; k <= params.radius; ++k)
                    for (const int aside : {-k, k})
                        if (const float far = far_at(depth, x + aside, y); far < out.depth[i]) {
                            out.depth[i] = far;
                            out.aside[i] = static_cast<int8_t>(aside);
                        }
            }
        return out;
    }

    static float far_at(const View& depth, int x, int y) {
        constexpr float kFar = std::numeric_limits<float>::infinity();
        if (!depth.rect.contains(x, y)) return kFar;
        const float z = *depth.at(x, y);
        return z > 0 ? z : kFar;
    }

    static void take(std::span<const View> from, int x, int y, Outputs out, int to_x, int to_y) {
        for (std::size_t c = 0; c < out.size(); ++c)
            *out[c].at(to_x, to_y) = from[c].rect.contains(x, y) ? with_one_nan(*from[c].at(x, y)) : 0.0F;
    }
};

}  // namespace

KEYLINE_NODE(nearer, Nearer)

}  // namespace keyline
