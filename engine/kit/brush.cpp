// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/brush.h"

#include <cmath>

namespace keyline {

std::vector<int> half_widths(Brush brush, double radius) {
    const auto covers = [&](double dx, double dy) {
        switch (brush) {
            case Brush::kDisk: return dx * dx + dy * dy <= radius * radius;
            case Brush::kDiamond: return dx + dy <= radius;
            case Brush::kSquare: break;
        }
        return dx <= radius && dy <= radius;
    };
    std::vector<int> out;
    int width = static_cast<int>(std::floor(radius));
    for (int dy = 0; dy <= static_cast<int>(std::floor(radius)); ++dy) {
        while (width > 0 && !covers(width, dy)) --width;
        out.push_back(width);
    }
    return out;
}

}  // namespace keyline
