// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/node/node_adaptor.h"

#include <algorithm>
#include <cmath>
#include <limits>

// Surface coordinates, and how much of a surface a pixel sees: what patterns are drawn with.

namespace KEYLINE_API keyline {

struct UvStep {
    double u = 0, v = 0;
};

// What a pixel sees: the surface around (u, v), as far as the steps to the next pixel in x and in y.
struct UvPlace {
    double u = 0, v = 0, alpha = 0;
    UvStep across, down;
};

// An interval of a coordinate: what a pixel covers of it.
struct Extent {
    double at = 0, size = 0;

    double from() const { return at - size / 2; }
    double to() const { return at + size / 2; }

    // Too small to be averaged over: what is left of a difference would be its rounding.
    bool is_point() const { return !(size > 1e-7 * std::max(1.0, std::abs(at))); }

    // How much of it lies in low … high, 0 … 1.
    double share(double low, double high) const {
        if (is_point()) return at >= low && at < high ? 1 : 0;
        return std::max(0.0, std::min(to(), high) - std::max(from(), low)) / size;
    }
};

// A coordinate at a pixel, with its steps to the next pixels in x and in y.  Steps without end count as large
// ones, which see the mean of everything.
inline Extent extent(double at, double across, double down) {
    constexpr double kLarge = 1e9;
    const double size = std::abs(across) + std::abs(down);
    return {at, size < kLarge ? size : kLarge};
}

// 0 up to `low`, 1 from `high` on; low < high.
inline double smooth_step(double low, double high, double x) {
    const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

// The coordinates of a tile.  With a third channel, A, they are premultiplied by it, as a renderer's
// antialiasing leaves them.
class UvMap {
public:
    explicit UvMap(std::span<const View> channels) : channels_(channels) {}

    // Alpha is 0 where there is no surface; nothing else is set then.  The steps are those to the nearer of
    // two neighbours on the surface: the other may lie behind a seam or on another object.
    UvPlace at(int x, int y) const;

private:
    UvPlace look_up(int x, int y) const;
    UvStep step(const UvPlace& here, int x, int y, int dx, int dy) const;

    std::span<const View> channels_;
};

// The mean colour of what a pixel sees, not premultiplied.
using PatternColor = std::array<double, 3>;

// Where coordinates are not finite.
inline constexpr PatternColor kNoColor{std::numeric_limits<double>::quiet_NaN(),
                                       std::numeric_limits<double>::quiet_NaN(),
                                       std::numeric_limits<double>::quiet_NaN()};

inline PatternColor pattern_color(const Color& c) { return {c.r, c.g, c.b}; }

// (1 − t) a + t b
inline PatternColor mix(const PatternColor& a, const PatternColor& b, double t) {
    PatternColor out;
    for (std::size_t c = 0; c < 3; ++c) out[c] = a[c] + (b[c] - a[c]) * t;
    return out;
}

// Adds a pattern on the U V or S T (and A) of an input: R G B A, premultiplied.  `color` is called for every
// pixel that has a surface, in any order and from any thread.
Stream add_pattern(Builder& builder, const Input& uv, double cost,
                   std::function<PatternColor(const UvPlace&)> color);

}  // namespace keyline
