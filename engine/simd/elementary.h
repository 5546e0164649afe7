// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"

// exp, log, pow, sine, cosine and probit that give the same bits on every machine.  The C library's do not:
// glibc picks another body where the processor has fused multiply-adds.  These are made of + − × ÷ alone;
// tables (Gaussian weights, tone curves) are built with them, and the kernels use the same body lane by lane.

namespace KEYLINE_API keyline {
namespace elementary {

// e^x, to 1e-15 of its value (denormal results: to one step).  0 below about −745, +∞ above about 709.8;
// NaN for NaN.
double exp(double x);

// The natural logarithm, to 1e-15 of its value.  −∞ for ±0, NaN below 0, +∞ for +∞, NaN for NaN.
double log(double x);

// x^y for x ≥ 0, to 1e-15 × (1 + |y log x|) of its value.  As in IEEE 754: x^0 is 1 and 1^y is 1, even for
// NaN; 0^y is 0 for y > 0 and +∞ for y < 0.  NaN for x < 0, whatever y is.
double pow(double x, double y);

struct SinCos {
    double sin, cos;
};

// Of an angle in degrees, to 1e-15; exact where the angle is a multiple of 90.  NaN unless it is finite.
SinCos sin_cos_degrees(double degrees);

// The x at which the normal distribution reaches p, to 1e-7 of it; for p from 1e-10 to 1 − 1e-10.
double probit(double p);

}  // namespace elementary
}  // namespace keyline
