// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/simd/elementary.h"

#include "engine/simd/elementary-inl.h"

#include <cmath>

namespace keyline::elementary {

namespace {

namespace body = simd::HWY_NAMESPACE;
namespace hn = hwy::HWY_NAMESPACE;

constexpr hn::CappedTag<double, 1> kOne;

}  // namespace

double exp(double x) { return hn::GetLane(body::exp(kOne, hn::Set(kOne, x))); }

double log(double x) { return hn::GetLane(body::log(kOne, hn::Set(kOne, x))); }

double pow(double x, double y) {
    if (y == 0 || x == 1) return 1;
    return exp(y * log(x));
}

SinCos sin_cos_degrees(double degrees) {
    if (!std::isfinite(degrees)) return {degrees - degrees, degrees - degrees};
    // fmod and nearbyint are exact, so what is left of the angle is too.
    const double turn = std::fmod(degrees, 360.0);
    const double quarters = std::nearbyint(turn / 90.0);
    const double x = (turn - 90.0 * quarters) * (0x1.921fb54442d18p+1 / 180.0);
    // The Taylor series, from their small ends; |x| ≤ π/4.
    double sine = 0, cosine = 0;
    for (int k = 18; k > 0; k -= 2) {
        cosine = (1 - cosine) * x * x / (k * (k - 1.0));
        sine = (1 - sine) * x * x / (k * (k + 1.0));
    }
    const double s = x * (1 - sine), c = 1 - cosine;
    switch (static_cast<int>(quarters) & 3) {
        case 0: return {s, c};
        case 1: return {c, -s};
        case 2: return {-s, -c};
        default: return {-c, s};
    }
}

// Wichura's algorithm AS 241 (1988), its shorter form.
double probit(double p) {
    const double q = p - 0.5;
    if (std::fabs(q) <= 0.425) {
        const double r = 0.180625 - q * q;
        return q * (((59.109374720 * r + 159.29113202) * r + 50.434271938) * r + 3.3871327179) /
               (((67.187563600 * r + 78.757757664) * r + 17.895169469) * r + 1);
    }
    const double r = std::sqrt(-log(q < 0 ? p : 1 - p)) - 1.6;
    const double x = (((0.17023821103 * r + 1.3067284816) * r + 2.7568153900) * r + 1.4234372777) /
                     ((0.12021132975 * r + 0.73700164250) * r + 1);
    return q < 0 ? -x : x;
}

}  // namespace keyline::elementary
