// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"

#include <array>
#include <cstdint>

namespace KEYLINE_API keyline {

// From black by violet, red and orange to a pale yellow, each lighter than the one before: for numbers from 0
// to 1, those outside as the nearest.  As a display takes it.
std::array<float, 3> heat(float number);

// One for each object: light, and rarely like another's.  Black for 0, which is nothing.
std::array<float, 3> colour_of_id(uint32_t id);

}  // namespace keyline
