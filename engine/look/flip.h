// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"

#include <array>
#include <vector>

// FLIP: how different two pictures look to somebody who flips between them (Andersson, Nilsson,
// Akenine-Möller, Oskarsson, Åström, Fairchild: "FLIP: A Difference Evaluator for Alternating Images", 2020).
// 0 is no difference to be seen, 1 the largest.

namespace KEYLINE_API keyline {

// Linear light of sRGB's primaries, from 0 to 1, row by row.
struct LinearPicture {
    int width = 0, height = 0;
    std::array<std::vector<float>, 3> rgb;
};

// As the paper has it: a monitor 0.7 m wide of 3840 pixels, seen from 0.7 m.
inline constexpr double kPixelsPerDegree = 67.0206432765823;

// By pixel.  The pictures are of one size.
std::vector<float> flip(const LinearPicture& reference, const LinearPicture& test,
                        double pixels_per_degree = kPixelsPerDegree);

}  // namespace keyline
