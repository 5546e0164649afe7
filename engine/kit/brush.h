// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/params/param_types.h"

#include <array>
#include <vector>

namespace KEYLINE_API keyline {

// What dilation and erosion look at around a pixel.
enum class Brush { kDisk, kSquare, kDiamond };

constexpr auto words(Brush) {
    return std::array{Word<Brush>{"disk", Brush::kDisk, "offsets with dx² + dy² ≤ radius²"},
                      Word<Brush>{"square", Brush::kSquare, "|dx| and |dy| ≤ radius"},
                      Word<Brush>{"diamond", Brush::kDiamond, "|dx| + |dy| ≤ radius"}};
}

// By distance in y, from 0: how far the brush reaches in x.
std::vector<int> half_widths(Brush brush, double radius);

}  // namespace keyline
