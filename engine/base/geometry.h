// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"

#include <algorithm>
#include <cstdint>

// Windows and regions of the pixel grid.  Everywhere in Keyline x runs right, y runs down, and a Rect is
// half-open: it holds the pixels x0 <= x < x1, y0 <= y < y1.  (OpenEXR's Box2i includes its maximum; the
// readers and writers convert at the border.)

namespace KEYLINE_API keyline {

// No coordinate of a window leaves ±kMaxCoordinate, so that sums of windows, halos and offsets fit an int.
inline constexpr int kMaxCoordinate = 1 << 29;

struct Rect {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

    constexpr int width() const { return x1 > x0 ? x1 - x0 : 0; }
    constexpr int height() const { return y1 > y0 ? y1 - y0 : 0; }
    constexpr bool empty() const { return x1 <= x0 || y1 <= y0; }
    constexpr int64_t area() const { return int64_t{width()} * height(); }
    constexpr bool contains(int x, int y) const { return x >= x0 && x < x1 && y >= y0 && y < y1; }
    constexpr bool contains(const Rect& r) const {
        return r.empty() || (r.x0 >= x0 && r.x1 <= x1 && r.y0 >= y0 && r.y1 <= y1);
    }
    friend constexpr bool operator==(const Rect& a, const Rect& b) = default;
};

// How far a stencil looks beyond the pixel it computes, in pixels, on both sides alike.
struct Halo {
    int x = 0, y = 0;
    friend constexpr bool operator==(const Halo& a, const Halo& b) = default;
};

// The pixels in both; {} where there are none, so that all empty intersections compare equal.
constexpr Rect intersect(const Rect& a, const Rect& b) {
    const Rect r{std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
    return r.empty() ? Rect{} : r;
}

// The smallest rectangle that holds both; an empty one adds nothing.
constexpr Rect unite(const Rect& a, const Rect& b) {
    if (a.empty()) return b.empty() ? Rect{} : b;
    if (b.empty()) return a;
    return {std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
}

// The pixels within `halo` of `r`; nothing is near an empty rectangle.
constexpr Rect grow(const Rect& r, Halo halo) {
    if (r.empty()) return {};
    return {r.x0 - halo.x, r.y0 - halo.y, r.x1 + halo.x, r.y1 + halo.y};
}

constexpr Rect translate(const Rect& r, int dx, int dy) {
    return {r.x0 + dx, r.y0 + dy, r.x1 + dx, r.y1 + dy};
}

// Division that rounds towards minus infinity: grid cells have one size on both sides of the origin.
constexpr int floor_div(int a, int b) { return a / b - ((a % b != 0) && ((a < 0) != (b < 0)) ? 1 : 0); }

}  // namespace keyline
