// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/filter.h"

#include "engine/simd/elementary.h"

#include <cmath>

namespace keyline {

namespace {

constexpr double kPi = 0x1.921fb54442d18p+1;

// Mitchell and Netravali's family of cubics.
double cubic(double x, double b, double c) {
    const double d = std::abs(x);
    if (d < 1) return (((12 - 9 * b - 6 * c) * d - 18 + 12 * b + 6 * c) * d * d + 6 - 2 * b) / 6;
    if (d < 2)
        return (((-b - 6 * c) * d + 6 * b + 30 * c) * d * d + (-12 * b - 48 * c) * d + 8 * b + 24 * c) / 6;
    return 0;
}

double sinc(double x) { return x == 0 ? 1 : elementary::sin_cos_degrees(180 * x).sin / (kPi * x); }

}  // namespace

double filter_radius(Filter filter) {
    switch (filter) {
        case Filter::kNearest:
        case Filter::kBox: return 0.5;
        case Filter::kTriangle: return 1;
        case Filter::kCubic:
        case Filter::kMitchell: return 2;
        case Filter::kLanczos: break;
    }
    return 3;
}

double filter_weight(Filter filter, double x) {
    switch (filter) {
        case Filter::kNearest:
        case Filter::kBox: return x >= -0.5 && x < 0.5 ? 1 : 0;
        case Filter::kTriangle: return std::abs(x) < 1 ? 1 - std::abs(x) : 0;
        case Filter::kCubic: return cubic(x, 0, 0.5);
        case Filter::kMitchell: return cubic(x, 1.0 / 3, 1.0 / 3);
        case Filter::kLanczos: break;
    }
    return std::abs(x) < 3 ? sinc(x) * sinc(x / 3) : 0;
}

double filter_stretch(Filter filter, double pixels) {
    return filter == Filter::kNearest || pixels < 1 ? 1 : pixels;
}

}  // namespace keyline
