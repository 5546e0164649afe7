// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"

// Perlin's improved noise (Improving Noise, SIGGRAPH 2002), for patterns.  It repeats every 256 units,
// differs little from one place to the next, and is ½ where all coordinates are whole.  Made of + − × alone,
// so that it has the same bits on every machine.

namespace KEYLINE_API keyline {
namespace noise {

// The paper's own function: 0 on whole coordinates, about −1 … 1.  NaN where a coordinate is not finite.
double perlin(double x, double y = 0, double z = 0);

// The same mapped to 0 … 1.
inline double value(double x, double y = 0, double z = 0) { return 0.5 + 0.5 * perlin(x, y, z); }

// value() from −1 to 1 again.
inline double signed_value(double x, double y = 0, double z = 0) { return 2 * value(x, y, z) - 1; }

struct Pair {
    double x, y;
};

// Two components that have nothing to do with each other: x is value() at the place itself, y at
// (x + 71.37, y + 43.61).
Pair pair(double x, double y);

}  // namespace noise
}  // namespace keyline
