// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/geometry.h"
#include "engine/kit/strokes.h"
#include "engine/measure/motion.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

// Lines as pixels: how even they came out, and how much they flicker, whoever drew them.

namespace KEYLINE_API keyline {

// How much of each pixel lines cover, 0 to 1, row by row.
struct DrawnLines {
    Rect window;
    std::vector<float> coverage;

    // Between four pixels' centres; 0 outside.
    double at(double x, double y) const;
};

// The A of an image or of its layer, or its only channel.  Throws Failure (kInput).
DrawnLines read_drawn_lines(const std::filesystem::path& file, const std::string& layer);

// How even strokes are in a picture.
struct DrawnWidth {
    double spread = 0;  // of the width, as a share of it
    double length = 0;  // of strokes that it is told from, in pixels; where it is 0, nothing is known
};

// The spread is 1.4826 times the median of what widths are off their mean within 10 pixels.  A width is the
// coverage across the stroke, summed up.  Ends, bends, and what has another line beside it do not count.
DrawnWidth width_in(const Strokes& strokes, const DrawnLines& drawn);

struct DrawnFrame {
    DrawnLines drawn;
    MotionPass motion;
};

// Of frames in order: what coverage changes to the next frame where it moved, Σ|a − b| by Σ max(a, b).  A
// pixel moves as the nearest thing within 2 pixels does, as a line goes with what it is drawn on; what leaves
// the view or comes out from behind something does not count.  Lines that move by parts of pixels flicker a
// little however well they are drawn.
// Nothing where there is nothing to compare.
std::optional<double> flicker_of(const std::vector<DrawnFrame>& frames);

}  // namespace keyline
