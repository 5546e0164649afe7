// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/support/run.h"

#include <cmath>
#include <string>

// What dilate and erode are, pixel by pixel.

namespace keyline::testing {

inline bool brush_covers(const std::string& shape, double radius, double dx, double dy) {
    if (shape == "square") return std::abs(dx) <= radius && std::abs(dy) <= radius;
    if (shape == "diamond") return std::abs(dx) + std::abs(dy) <= radius;
    return dx * dx + dy * dy <= radius * radius;
}

// -0 lies below +0.
inline bool is_less(float a, float b) { return a < b || (a == b && std::signbit(a) && !std::signbit(b)); }

// The largest sample, or the smallest, under the brush and inside the window, NaN passed over; 0 where there
// is none.
inline Image extremum(const Image& in, const std::string& shape, double radius, bool largest) {
    Image out = in;
    const int reach = static_cast<int>(radius);
    for (Image::Channel& c : out.channels)
        out.fill(c.name, [&](int x, int y) {
            float best = std::nanf("");
            for (int dy = -reach; dy <= reach; ++dy)
                for (int dx = -reach; dx <= reach; ++dx) {
                    if (!in.window.contains(x + dx, y + dy) || !brush_covers(shape, radius, dx, dy)) continue;
                    const float s = in.at(c.name, x + dx, y + dy);
                    const bool better = largest ? is_less(best, s) : is_less(s, best);
                    if (better || std::isnan(best)) best = s;
                }
            return std::isnan(best) ? 0 : best;
        });
    return out;
}

inline void expect_extremum(const std::string& node, const Image& in, std::initializer_list<double> radii) {
    for (const char* shape : {"disk", "square", "diamond"})
        for (const double radius : radii)
            EXPECT_TRUE(same(run(node, {{"radius", radius}, {"shape", shape}}, in, {.tile = 20}),
                             extremum(in, shape, radius, node == "dilate")))
                << shape << ' ' << radius;
}

// Two values, as lines are: nodes may take another way for them.
inline Image lines(const Rect& window, unsigned seed) {
    Image image = noise(window, {"edge"}, seed);
    for (float& s : image.channels[0].samples) s = s > 0.93F ? 1.0F : 0.0F;
    return image;
}

// Greys among which are NaN, whole patches of them, zeros of both signs and infinities.
inline Image awkward(const Rect& window, unsigned seed) {
    Image image = noise(window, {"R", "Z"}, seed, -1, 1);
    std::size_t i = seed;
    for (Image::Channel& c : image.channels)
        for (float& s : c.samples) {
            ++i;
            if (i % 5 == 0) s = std::nanf("");
            if (i % 7 == 0) s = i % 2 == 0 ? 0.0F : -0.0F;
            if (i % 301 == 0) s = i % 2 == 0 ? HUGE_VALF : -HUGE_VALF;
        }
    for (int y = window.y0; y < window.y0 + 12 && y < window.y1; ++y)
        for (int x = window.x0; x < window.x0 + 12 && x < window.x1; ++x) image.at("R", x, y) = std::nanf("");
    return image;
}

}  // namespace keyline::testing
