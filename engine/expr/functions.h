// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

// The functions of expressions, from numbers to a number.  `at` is where a fault is told; all throw
// ExpressionFault.

namespace KEYLINE_API keyline {

inline constexpr double kPi = 3.14159265358979323846;

std::vector<std::string> function_names();

// Whether there is such a function, and whether it takes so many values.
void check_function(const std::string& name, std::size_t at);
void check_arguments(const std::string& name, std::size_t count, std::size_t at);

double call_function(const std::string& name, std::span<const double> values);

// x^y, by multiplication where y is a whole number.  NaN where it is no number, as the square root of −1.
double power(double x, double y);

// The remainder with the sign of y, so that it counts on through 0.
double modulo(double x, double y);

// frame → the last of those that are held for `length` frames each, the first of them beginning at `first`.
double held_frame(double frame, double first, double length);

}  // namespace keyline
