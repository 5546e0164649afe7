// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/simd/extrema_layout.h"
#include "engine/simd/rows.h"

// What follows foreach_target.h is compiled once for each target.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/simd/extrema_shape.cpp"
#include <hwy/foreach_target.h>
#include "engine/simd/extrema-inl.h"
// clang-format on

// Each row of the input gives its part to every row of the output that sees it.  A window of any length is
// the maximum of two windows of a power of two, and those are made once a row.

HWY_BEFORE_NAMESPACE();
namespace keyline::simd::HWY_NAMESPACE {

// line k of `lines`, at i: the maximum of the 2^k keys from i on in line 0.
HWY_INLINE void build_levels(int32_t* lines, const ShapeLayout& layout, int n) {
    for (int k = 1; k < layout.levels; ++k) {
        const int covered = 1 << (k - 1);
        max_row(lines, lines + covered, n - 2 * covered + 1, lines + layout.line);
        lines += layout.line;
    }
}

// Raises the rows a and b, n long, to the maximum of two lines; a and b may be the same.
HWY_INLINE void raise_rows(const int32_t* left, const int32_t* right, int n, int32_t* a, int32_t* b) {
    if (a == b) {
        for (int i = 0; i < n; i += kLanes) {
            const auto window = hn::Max(hn::LoadU(kInt, left + i), hn::LoadU(kInt, right + i));
            hn::StoreU(hn::Max(hn::LoadU(kInt, a + i), window), kInt, a + i);
        }
        return;
    }
    for (int i = 0; i < n; i += kLanes) {
        const auto window = hn::Max(hn::LoadU(kInt, left + i), hn::LoadU(kInt, right + i));
        const auto raised_a = hn::Max(hn::LoadU(kInt, a + i), window);
        const auto raised_b = hn::Max(hn::LoadU(kInt, b + i), window);
        hn::StoreU(raised_a, kInt, a + i);
        hn::StoreU(raised_b, kInt, b + i);
    }
}

// Gives row y of the input, counted from the output's first, to the n columns of all rows that see it.
HWY_INLINE void spread_row(const int32_t* lines, const ShapeLayout& layout, int y, int n, int32_t* sums) {
    const auto row = [&](int at) { return sums + static_cast<std::ptrdiff_t>(at) * layout.pitch; };
    for_each_distance(y, layout.height, layout.reach_y, [&](int d, int a, int b) HWY_ATTR {
        const int w = layout.shape[static_cast<std::size_t>(d)], length = 2 * w + 1;
        const int level = window_levels(length) - 1;
        const int32_t* left = lines + static_cast<std::ptrdiff_t>(level) * layout.line + layout.reach_x - w;
        raise_rows(left, left + length - (1 << level), n, row(a), row(b));
    });
}

void shape_strip(const View& in, const MutView& out, int x0, int n, const ShapeLayout& layout,
                 const Order& order, int32_t* sums) {
    int32_t* lines = sums + static_cast<std::ptrdiff_t>(layout.height) * layout.pitch;
    fill_absent(sums, layout.height * layout.pitch);
    const int looked_at = n + 2 * layout.reach_x;
    const int first = HWY_MAX(in.rect.y0, out.rect.y0 - layout.reach_y);
    const int last = HWY_MIN(in.rect.y1, out.rect.y1 + layout.reach_y);
    for (int y = first; y < last; ++y) {
        load_keys(in, order, x0 - layout.reach_x, y, looked_at, lines);
        build_levels(lines, layout, looked_at);
        spread_row(lines, layout, y - out.rect.y0, n, sums);
    }
    for (int y = out.rect.y0; y < out.rect.y1; ++y, sums += layout.pitch)
        store_values(sums, order, n, out.at(x0, y));
}

void shape(const View& in, const MutView& out, const ShapeLayout& layout, Extremum which,
           int32_t* workspace) {
    const Order order(which);
    for (int x = out.rect.x0; x < out.rect.x1; x += layout.strip)
        shape_strip(in, out, x, HWY_MIN(layout.strip, out.rect.x1 - x), layout, order, workspace);
}

}  // namespace keyline::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace keyline::simd {

HWY_EXPORT(shape);

std::size_t shape_workspace(const Rect& out, HalfWidths half_widths) {
    return ShapeLayout(out, half_widths).size();
}

void shape_extremum(const View& in, const MutView& out, HalfWidths half_widths, Extremum which,
                    std::span<int32_t> workspace) {
    HWY_DYNAMIC_DISPATCH(shape)(in, out, ShapeLayout(out.rect, half_widths), which, workspace.data());
}

}  // namespace keyline::simd
#endif  // HWY_ONCE
