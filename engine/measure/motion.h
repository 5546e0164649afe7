// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/geometry.h"
#include "engine/kit/strokes.h"
#include "engine/measure/accuracy.h"

#include <array>
#include <filesystem>
#include <string>
#include <vector>

// A drawing from frame to frame: do lines stay on what they are drawn on, or do they swim, blink and drift?

namespace KEYLINE_API keyline {

// How what is seen in each pixel moves, in pixels, y up: it was at (X, Y) from here a frame ago, and will be
// at (−Z, −W) in the next, as Cycles has it.
struct MotionPass {
    Rect window;
    std::array<std::vector<float>, 4> vector;  // X Y Z W, row by row
    std::vector<float> depth;                  // empty where it is not known
};

// The layer that is called `layer`, or ends so, of an image; depth from one that ends in "Depth" where there
// is one.  Throws Failure (kInput).
MotionPass read_motion(const std::filesystem::path& file, const std::string& layer);

struct MovingFrame {
    Strokes drawing;
    MotionPass motion;
};

struct Steadiness {
    std::size_t pairs = 0;  // of frames that follow each other
    double length = 0;      // of lines that were looked for in the next frame, and in the one before
    Offsets swim;           // what they are off there, across the line
    double pops = 0;        // the share that has no line there, in runs of 4 pixels and more
    double flecks = 0;      // and in shorter ones
    double lost_ink = 0;    // both, weighed by the line's width
    double drift = 0;       // what is found is off by so much on average, in pixels
    double shot_drift = 0;  // and lines of the first frame in the last
    double drifted = 0;     // the length that could be followed so far
};

// Frames in order.  What is carried out of view, or behind something else, does not count.
Steadiness steadiness_of(const std::vector<MovingFrame>& frames, const AccuracyOptions& options);

}  // namespace keyline
