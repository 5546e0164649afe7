// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/kit/borders.h"

#include <array>
#include <vector>

// Which of the two objects at a border is in front, and where they touch.

namespace keyline {

// A run of a border's crossings in which one object is in front by a step, or in which both meet.
struct OwnedRun {
    int first = 0, count = 0;  // of the border's crossings; of a closed border it may go on over the end
    bool meets = false;
    uint32_t owner = 0;
};

struct StepLimits {
    double pixel_angle;          // what a pixel covers at depth 1
    std::array<double, 2> step;  // as ContourOptions has it
};

// In order, all crossings of the border in one run each.
std::vector<OwnedRun> runs_of(const BorderMap& map, const Border& border, const StepLimits& limits);

}  // namespace keyline
