// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/node/node_adaptor.h"
#include "engine/node/pixel_loop.h"
#include "engine/simd/rows.h"

#include <fmt/format.h>

namespace keyline {

namespace {

// The second difference, of pairs of opposite neighbours.  Where one of a pair lies beyond the data window,
// the image goes on as straight as it came: a repeated edge would bend every slope there.
struct Laplacian {
    static constexpr Info info{
        "laplacian",
        "How much the neighbours of a pixel are above it, summed; beyond its edges the image "
        "goes on straight."};

    struct Params {
        Input in;
        int neighbours = 4;

        static constexpr auto fields = declare(
            input(&Params::in, "in", "The image; each channel by itself."),
            field(&Params::neighbours, "neighbours", "4, or 8 with the diagonal ones.", between(4, 8)));
    };

    static void check(const Params& p, Check& c) {
        if (p.neighbours != 4 && p.neighbours != 8)
            c.error("neighbours", fmt::format("'neighbours' is {}; it must be 4 or 8", p.neighbours));
    }

    explicit Laplacian(const Params& p) : diagonals(p.neighbours == 8) {}

    Halo halo() const { return {1, 1}; }

    void compute(const View& in, const MutView& out, Scratch&) const {
        const Rect& rect = out.rect;
        const simd::Margin beside = simd::margin_x(in, rect);
        const int n = rect.width();
        for (int y = rect.y0; y < rect.y1; ++y) {
            const simd::Margin over = simd::margin_y(in, y);
            const bool down = over.before > 0 && over.after > 0;
            const simd::Rows3 rows = simd::rows_around(in, rect.x0, y);
            float* to = out.row(y);
            for (int x = 1; x < n - 1; ++x) to[x] = bend(rows, x, true, down);
            to[0] = bend(rows, 0, beside.before > 0 && (n > 1 || beside.after > 0), down);
            if (n > 1) to[n - 1] = bend(rows, n - 1, beside.after > 0, down);
        }
    }

    const bool diagonals;

private:
    // In double, where the sum of floats as near each other as neighbours are is exact: on a slope it is 0.
    // `across`, `down`: whether there are neighbours on both sides.
    float bend(const simd::Rows3& rows, int x, bool across, bool down) const {
        const double twice = 2 * double{rows.at[x]};
        const auto pair = [&](float a, float b) { return double{a} + double{b} - twice; };
        double sum = 0;
        if (across) sum += pair(rows.at[x - 1], rows.at[x + 1]);
        if (down) sum += pair(rows.above[x], rows.below[x]);
        if (diagonals && across && down)
            sum += pair(rows.above[x - 1], rows.below[x + 1]) + pair(rows.above[x + 1], rows.below[x - 1]);
        return with_one_nan(static_cast<float>(sum));
    }
};

}  // namespace

KEYLINE_NODE(laplacian, Laplacian)

}  // namespace keyline
