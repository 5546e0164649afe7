// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/node_adaptor.h"
#include "engine/pixel_loop.h"
#include "engine/simd/rows.h"

#include <fmt/format.h>

namespace keyline {

namespace {

// The second difference: what lies beyond the data window repeats its edge.
struct Laplacian {
    static constexpr Info info{"laplacian", "How much the neighbours of a pixel are above it, summed."};

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
        const int left = in.rect.x0 < rect.x0 ? -1 : 0, right = in.rect.x1 > rect.x1 ? 1 : 0;
        const int n = rect.width();
        for (int y = rect.y0; y < rect.y1; ++y) {
            const simd::Rows3 rows = simd::rows_around(in, rect.x0, y);
            float* to = out.row(y);
            for (int x = 1; x < n - 1; ++x) to[x] = at(rows, x, -1, 1);
            to[0] = at(rows, 0, left, n > 1 ? 1 : right);
            if (n > 1) to[n - 1] = at(rows, n - 1, -1, right);
        }
    }

    const bool diagonals;

private:
    // In double, where the sum of floats as near each other as neighbours are is exact: on a slope it is 0.
    float at(const simd::Rows3& rows, int x, int before, int after) const {
        const auto sum = [&](const float* row) { return double{row[x + before]} + double{row[x + after]}; };
        const double cross = sum(rows.at) + (double{rows.above[x]} + double{rows.below[x]});
        const double centre = rows.at[x];
        const double all =
            diagonals ? cross + (sum(rows.above) + sum(rows.below)) - 8 * centre : cross - 4 * centre;
        return with_one_nan(static_cast<float>(all));
    }
};

}  // namespace

KEYLINE_NODE(laplacian, Laplacian)

}  // namespace keyline
