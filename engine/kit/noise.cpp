// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/noise.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace keyline::noise {

namespace {

// The paper's permutation of 0 … 255.
constexpr std::array<uint8_t, 256> kPermutation{
    151, 160, 137, 91,  90,  15,  131, 13,  201, 95,  96,  53,  194, 233, 7,   225, 140, 36,  103, 30,
    69,  142, 8,   99,  37,  240, 21,  10,  23,  190, 6,   148, 247, 120, 234, 75,  0,   26,  197, 62,
    94,  252, 219, 203, 117, 35,  11,  32,  57,  177, 33,  88,  237, 149, 56,  87,  174, 20,  125, 136,
    171, 168, 68,  175, 74,  165, 71,  134, 139, 48,  27,  166, 77,  146, 158, 231, 83,  111, 229, 122,
    60,  211, 133, 230, 220, 105, 92,  41,  55,  46,  245, 40,  244, 102, 143, 54,  65,  25,  63,  161,
    1,   216, 80,  73,  209, 76,  132, 187, 208, 89,  18,  169, 200, 196, 135, 130, 116, 188, 159, 86,
    164, 100, 109, 198, 173, 186, 3,   64,  52,  217, 226, 250, 124, 123, 5,   202, 38,  147, 118, 126,
    255, 82,  85,  212, 207, 206, 59,  227, 47,  16,  58,  17,  182, 189, 28,  42,  223, 183, 170, 213,
    119, 248, 152, 2,   44,  154, 163, 70,  221, 153, 101, 155, 167, 43,  172, 9,   129, 22,  39,  253,
    19,  98,  108, 110, 79,  113, 224, 232, 178, 185, 112, 104, 218, 246, 97,  228, 251, 34,  242, 193,
    238, 210, 144, 12,  191, 179, 162, 241, 81,  51,  145, 235, 249, 14,  239, 107, 49,  192, 214, 31,
    181, 199, 106, 157, 184, 84,  204, 176, 115, 121, 50,  45,  127, 4,   150, 254, 138, 236, 205, 93,
    222, 114, 67,  29,  24,  72,  243, 141, 128, 195, 78,  66,  215, 61,  156, 180};

unsigned permuted(unsigned i) { return kPermutation[i % 256]; }

// From 0 to 1 with no first and second derivative at either end.
double fade(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }

double lerp(double t, double a, double b) { return a + t * (b - a); }

struct Direction {
    double x, y, z;
};

// To the middles of a cube's edges, four of them twice.  A table, because no processor could foresee which of
// several branches a hash takes.
constexpr std::array<Direction, 16> kDirections{{{1, 1, 0},
                                                 {-1, 1, 0},
                                                 {1, -1, 0},
                                                 {-1, -1, 0},
                                                 {1, 0, 1},
                                                 {-1, 0, 1},
                                                 {1, 0, -1},
                                                 {-1, 0, -1},
                                                 {0, 1, 1},
                                                 {0, -1, 1},
                                                 {0, 1, -1},
                                                 {0, -1, -1},
                                                 {1, 1, 0},
                                                 {0, -1, 1},
                                                 {-1, 1, 0},
                                                 {0, -1, -1}}};

double gradient(unsigned hash, double x, double y, double z) {
    const Direction& d = kDirections[hash % 16];
    return d.x * x + d.y * y + d.z * z;
}

// A coordinate's cell, of 256, and what is left of it.
struct Cell {
    unsigned index;
    double rest, faded;
};

Cell cell(double at) {
    if (at == 0) return {};  // a missing coordinate
    constexpr double kFitsInt = 1 << 30;
    if (std::abs(at) < kFitsInt) {  // as below, without a call of floor()
        const int toward_zero = static_cast<int>(at);
        const int whole = toward_zero - (toward_zero > at ? 1 : 0);
        const double rest = at - whole;
        return {static_cast<unsigned>(whole) % 256, rest, fade(rest)};
    }
    const double whole = std::floor(at);
    const double of_256 = whole - 256 * std::floor(whole / 256);
    return {static_cast<unsigned>(of_256), at - whole, fade(at - whole)};
}

// The square of corners around (x, y) that is `up` cells above the one of z.
double layer(const Cell& x, const Cell& y, const Cell& z, unsigned up) {
    const auto corner = [&](unsigned right, unsigned down) {
        const unsigned hash = permuted(permuted(permuted(x.index + right) + y.index + down) + z.index + up);
        return gradient(hash, x.rest - right, y.rest - down, z.rest - up);
    };
    const double near = lerp(x.faded, corner(0, 0), corner(1, 0));
    if (y.rest == 0) return near;
    return lerp(y.faded, near, lerp(x.faded, corner(0, 1), corner(1, 1)));
}

}  // namespace

double perlin(double x, double y, double z) {
    if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z))
        return std::numeric_limits<double>::quiet_NaN();
    const Cell cx = cell(x), cy = cell(y), cz = cell(z);
    const double near = layer(cx, cy, cz, 0);
    return cz.rest == 0 ? near : lerp(cz.faded, near, layer(cx, cy, cz, 1));
}

Pair pair(double x, double y) { return {value(x, y), value(x + 71.37, y + 43.61)}; }

}  // namespace keyline::noise
