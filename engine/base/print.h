// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/base/geometry.h"

#include <concepts>
#include <ostream>
#include <string>

namespace KEYLINE_API keyline {

// "480 × 270 at (0, 0)"; "empty".
std::string to_string(const Rect& rect);

// Whatever has a to_string() can be streamed, and is printed so by a test that fails.
template <class T>
concept Printed = requires(const T& t) {
    { to_string(t) } -> std::same_as<std::string>;
};
template <Printed T>
std::ostream& operator<<(std::ostream& out, const T& t) {
    return out << to_string(t);
}

}  // namespace keyline
