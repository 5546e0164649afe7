// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/kit/strokes.h"
#include "engine/kit/thin_parts.h"

#include <vector>

// What is thin as one stroke along its middle, instead of two outlines that run into each other.

namespace KEYLINE_API keyline {

struct MiddleOptions {
    double widest = 0;      // pixels
    double min_length = 4;  // what is shorter keeps its outlines; as does what is short for how wide it is
    Rect extent;            // where the picture ends
};

// Thin things belong to themselves; a gap between nearer things belongs to these, and what is seen through it
// is their `far`.
struct Middles {
    std::vector<Stroke> things, gaps;
};

// The points may be in any order.
Middles middles_of(std::vector<ThinPoint> points, const MiddleOptions& options);

// The outlines without those of what has a middle.  Where a thing grows thick its outlines begin at the end
// of its middle; that end is then joined.
std::vector<Stroke> outlines_beside(std::vector<Stroke> outlines, Middles& middles, double min_length);

}  // namespace keyline
