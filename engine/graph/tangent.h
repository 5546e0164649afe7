// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/json/value.h"

namespace keyline {

// How a curve leaves a key or arrives at it: the point that it heads for or comes from, seen from the key.
struct Tangent {
    double frames = 0;
    const Value* rise = nullptr;  // null: none, the curve goes straight for the other key
    Place place = {};

    explicit operator bool() const { return rise != nullptr; }
};

// The weights of the four points of a cubic Bézier curve.
struct BezierWeights {
    double start, leaving, arriving, end;
};

// Where a curve over `frames` frames is at a frame of it.  Its inner points stand at frames between the ends,
// so that there is one such place.
BezierWeights bezier_at(double frame, double leaving, double arriving, double frames);

}  // namespace keyline
