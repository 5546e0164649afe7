// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/graph/tangent.h"

namespace keyline {

namespace {

BezierWeights weights(double t) {
    const double s = 1 - t;
    return {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
}

}  // namespace

// By halving: the frames grow along the curve, and every machine halves alike.
BezierWeights bezier_at(double frame, double leaving, double arriving, double frames) {
    constexpr int kHalvings = 52;  // as many as a double has bits
    double low = 0, high = 1;
    for (int i = 0; i < kHalvings; ++i) {
        const double middle = (low + high) / 2;
        const BezierWeights w = weights(middle);
        (w.leaving * leaving + w.arriving * arriving + w.end * frames <= frame ? low : high) = middle;
    }
    return weights(low);
}

}  // namespace keyline
