// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/simd/extrema_layout.h"
#include "engine/simd/rows.h"

#include <utility>

// What follows foreach_target.h is compiled once for each target.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/simd/extrema_box.cpp"
#include <hwy/foreach_target.h>
#include "engine/simd/extrema-inl.h"
// clang-format on

// The maximum along the rows, by windows of 1, 2, 4, … pixels; then down the columns van Herk's way: of any
// window of L rows, the part in one block of L is a maximum from the block's end backwards, and the part in
// the next a maximum from its start forwards.

HWY_BEFORE_NAMESPACE();
namespace keyline::simd::HWY_NAMESPACE {

// out[i] = the maximum of keys[i … i + length − 1], for 0 ≤ i < n.  `keys` and `spare`, of n + length − 1,
// are used up.
HWY_INLINE void window_maximum(int32_t* keys, int32_t* spare, int n, int length, int32_t* out) {
    int covered = 1;
    for (; 2 * covered <= length; covered *= 2) {
        max_row(keys, keys + covered, n + length - 2 * covered, spare);
        std::swap(keys, spare);
    }
    max_row(keys, keys + length - covered, n, out);
}

// From rows of horizontal maxima to the output.
HWY_INLINE void fold_rows(int32_t* rows, const BoxLayout& layout, const Order& order, const MutView& out) {
    const int length = 2 * layout.reach_y + 1, height = out.rect.height(), n = out.rect.width();
    const auto row = [&](int y) { return rows + static_cast<std::ptrdiff_t>(y) * layout.pitch; };
    int32_t* forwards = row(layout.rows);
    for (int start = 0; start < height; start += length) {
        for (int y = start + length - 2; y >= start; --y) max_row(row(y), row(y + 1), n, row(y));
        fill_absent(forwards, n);
        for (int y = start; y < HWY_MIN(start + length, height); ++y) {
            if (y > start) max_row(forwards, row(y + length - 1), n, forwards);
            max_row(row(y), forwards, n, row(y));
            store_values(row(y), order, n, out.row(out.rect.y0 + y));
        }
    }
}

void box(const View& in, const MutView& out, const BoxLayout& layout, Extremum which, int32_t* rows) {
    const Order order(which);
    const int n = out.rect.width(), x = out.rect.x0 - layout.reach_x, y = out.rect.y0 - layout.reach_y;
    int32_t* keys = rows + static_cast<std::ptrdiff_t>(layout.rows + 1) * layout.pitch;
    for (int i = 0; i < layout.rows; ++i, rows += layout.pitch) {
        if (y + i < in.rect.y0 || y + i >= in.rect.y1) {
            fill_absent(rows, n);
            continue;
        }
        load_keys(in, order, x, y + i, n + 2 * layout.reach_x, keys);
        window_maximum(keys, keys + layout.line, n, 2 * layout.reach_x + 1, rows);
    }
    fold_rows(rows - static_cast<std::ptrdiff_t>(layout.rows) * layout.pitch, layout, order, out);
}

}  // namespace keyline::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace keyline::simd {

HWY_EXPORT(box);

std::size_t box_workspace(const Rect& out, HalfWidths shape) { return BoxLayout(out, shape).size(); }

void box_extremum(const View& in, const MutView& out, HalfWidths shape, Extremum which,
                  std::span<int32_t> workspace) {
    HWY_DYNAMIC_DISPATCH(box)(in, out, BoxLayout(out.rect, shape), which, workspace.data());
}

}  // namespace keyline::simd
#endif  // HWY_ONCE
