// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/filter.h"

#include "engine/base/error.h"
#include "engine/simd/elementary.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

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

int nearest_pixel(double v) {
    return static_cast<int>(std::clamp(v, -double(kMaxCoordinate), double(kMaxCoordinate)));
}

void refuse_unreachable(const Rect& window) {
    const int least = std::min(window.x0, window.y0), most = std::max(window.x1, window.y1);
    if (least > -kMaxCoordinate && most < kMaxCoordinate) return;
    fail(ErrorKind::kGraph,
         fmt::format("the picture would reach beyond pixel ±{}, which is as far as a window can",
                     kMaxCoordinate),
         "move or scale it less, or crop it before");
}

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
