// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/kit/noise.h"
#include "tests/nodes/plate.h"

#include <array>
#include <cmath>

// Patterns on surface coordinates: images of those, and what a pattern's formula makes of them.

namespace keyline::testing {

using Rgb = std::array<double, 3>;

inline double fract(double x) { return x - std::floor(x); }
inline double modulo(double x, double m) { return x - m * std::floor(x / m); }

inline Rgb times(const Rgb& a, double f) { return {a[0] * f, a[1] * f, a[2] * f}; }

// Coordinates at random, each pixel that has a surface between four that have none: it has no extent.
inline Image lonely_points(unsigned seed) {
    const Rect window{-20, 5, 61, 66};
    Image uv = noise(window, {"A", "U", "V"}, seed, -1, 1.5F);
    uv.fill("A", [](int x, int y) { return (x + y) % 2 == 0 ? 1 : 0; });
    return uv;
}

// One surface, `step` from a pixel to the next, from (u, v) on.
inline Image plane(double u, double v, double step_u, double step_v, int size = 40) {
    Image uv({0, 0, size, size}, {"U", "V"});
    uv.fill("U", [&](int x, int) { return u + x * step_u; });
    uv.fill("V", [&](int, int y) { return v + y * step_v; });
    return uv;
}

inline Image paint(const std::string& type, const Json& params, const Image& uv,
                   const RunOptions& options = {}) {
    return run(type, params, std::map<std::string, Image>{{"uv", uv}}, options);
}

template <class Formula>
Image drawn(const Image& uv, const Formula& formula) {
    Image out(uv.window, {"R", "G", "B", "A"});
    out.display = uv.display;
    for (int y = uv.window.y0; y < uv.window.y1; ++y)
        for (int x = uv.window.x0; x < uv.window.x1; ++x) {
            const double alpha = uv.has("A") ? double{uv.at("A", x, y)} : 1.0;
            if (alpha == 0) continue;
            const Rgb color = formula(double{uv.at("U", x, y)} / alpha, double{uv.at("V", x, y)} / alpha);
            out.at("R", x, y) = static_cast<float>(color[0] * alpha);
            out.at("G", x, y) = static_cast<float>(color[1] * alpha);
            out.at("B", x, y) = static_cast<float>(color[2] * alpha);
            out.at("A", x, y) = static_cast<float>(alpha);
        }
    return out;
}

// The same averaged over each pixel's step in U and in V.
template <class Formula>
Image drawn_finely(const Image& uv, double step_u, double step_v, const Formula& formula, int points_u = 48,
                   int points_v = 48) {
    return drawn(uv, [&](double u, double v) {
        Rgb sum{};
        for (int i = 0; i < points_u; ++i)
            for (int j = 0; j < points_v; ++j) {
                const Rgb one = formula(u + step_u * ((i + 0.5) / points_u - 0.5),
                                        v + step_v * ((j + 0.5) / points_v - 0.5));
                for (std::size_t c = 0; c < 3; ++c) sum[c] += one[c] / (points_u * points_v);
            }
        return sum;
    });
}

struct Differences {
    double mean = 0, largest = 0;
};

inline Differences differences(const Image& a, const Image& b) {
    Differences out;
    std::size_t count = 0;
    for (const char* channel : {"R", "G", "B"}) {
        const auto &of_a = a.channel(channel).samples, &of_b = b.channel(channel).samples;
        for (std::size_t i = 0; i < of_a.size(); ++i, ++count) {
            const double d = std::abs(double{of_a[i]} - double{of_b[i]});
            out.mean += d;
            out.largest = std::max(out.largest, d);
        }
    }
    out.mean /= static_cast<double>(count);
    return out;
}

// How far the first channel strays from its mean.
inline double deviation(const Image& image) {
    double sum = 0, squares = 0;
    for (const float s : image.channel("R").samples) {
        sum += double{s};
        squares += double{s} * double{s};
    }
    const double n = static_cast<double>(image.channel("R").samples.size());
    return std::sqrt(std::max(0.0, squares / n - sum / n * (sum / n)));
}

}  // namespace keyline::testing
