// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/geometry.h"
#include "engine/kit/strokes.h"
#include "engine/measure/motion.h"

#include <filesystem>
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

// How much the width that strokes have in a picture changes along them, as a share of it: 1.4826 times the
// median of what it is off its mean within 10 pixels.  Width is the coverage across the stroke, summed up.
// Ends, bends, and what has another line beside it do not count; 0 where nothing else is left.
double unevenness_of(const Strokes& strokes, const DrawnLines& drawn);

struct DrawnFrame {
    DrawnLines drawn;
    MotionPass motion;
};

// Of frames in order: what coverage changes to the next frame where it moved, Σ|a − b| by Σ max(a, b).  A
// pixel moves as the nearest thing within 2 pixels does, as a line goes with what it is drawn on; what leaves
// the view or comes out from behind something does not count.  Lines that move by parts of pixels flicker a
// little however well they are drawn.
double flicker_of(const std::vector<DrawnFrame>& frames);

}  // namespace keyline
