// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/kit/strokes.h"

// What shows in a drawing alone: whether its lines are even, whole and few.

namespace KEYLINE_API keyline {

struct Form {
    std::size_t strokes = 0, vertices = 0;
    double length = 0;           // of all, in pixels
    double doubles = 0;          // the share of it that runs along a stroke before it, within 1.5 pixels
    std::size_t ends = 0;        // of strokes that are not closed
    std::size_t loose_ends = 0;  // with no other line within 1.5 pixels, and away from the rim
    std::size_t objects = 0;     // that have outlines and lie wholly in view
    std::size_t closed = 0;      // of which so many have an outline without a loose end
    double ripple = 0;           // rms of what the middle is off the parabola through the 6 pixels around it
    double width_slope = 0;   // 95 in a hundred places change their width by less, per pixel, away from ends
    double width_spread = 0;  // of the width within 6 pixels around, as a share of it, rms
    std::size_t curves = 0;   // cubic ones that leave no point by more than 0.2 pixels

    double loose_per_thousand() const {
        return length > 0 ? 1000 * static_cast<double>(loose_ends) / length : 0;
    }
    double curves_per_hundred() const { return length > 0 ? 100 * static_cast<double>(curves) / length : 0; }
};

Form form_of(const Strokes& drawing);

}  // namespace keyline
