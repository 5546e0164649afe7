// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/kit/carried_strokes.h"

#include <vector>

// Strokes that hold together over frames: what a few frames say of a line is nearer to the truth than what
// one of them does, and a line that most of them have does not blink.

namespace KEYLINE_API keyline {

// Another frame, as it is seen from this one.
struct FrameBeside {
    int since = 0;                              // how many frames later; below 0: earlier
    const CarriedStrokes* there = nullptr;      // its strokes, carried here
    const CarriedStrokes* from_here = nullptr;  // this frame's, carried there
};

// Of frames t − 2 … t + 2, or t − 1 … t + 1, the one in the middle.  Its lines lie across their way where on
// average they lie in all frames, and are as wide as they are there; with fewer frames that have them they
// grow thin, and are gone where hardly one does.  What the frames on both sides have, and this one has not,
// is taken from them.  A frame that can't see a place has no say in it, and one without strokes none at all.
Strokes steadied(const Strokes& here, const std::vector<FrameBeside>& beside);

}  // namespace keyline
