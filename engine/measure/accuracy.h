// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/kit/strokes.h"

#include <vector>

// A drawing against lines that are known to be true: are they where they should be, all of them, and no
// others?

namespace KEYLINE_API keyline {

struct AccuracyOptions {
    double within = 1;  // how far a line may be from the true one, in pixels of the drawing
    double angle = 30;  // and by how much it may turn away from it, in degrees
};

// How far off lines are that have a true one beside them, in pixels, across it; positive is outside of what
// owns the drawn line.
struct Offsets {
    double bias = 0, rms = 0;
    double robust = 0;  // 1.4826 × the median of what is off: what the eye sees along most of the way
    double most = 0;    // of 95 in a hundred
};

// Lines of one kind.
struct KindOfLines {
    StrokeKind kind = StrokeKind::kUser;
    double length = 0;   // in pixels
    double matched = 0;  // of which so much has a line of the other drawing beside it
    Offsets offsets;     // of drawn lines only
};

struct Accuracy {
    std::vector<KindOfLines> drawn;  // by the drawing's kinds; a true line is matched by one of them
    std::vector<KindOfLines> truth;  // by the truth's; several may lie on each other, and match the same line
    Offsets offsets;                 // of the whole drawing
    double precision = 0, recall = 0;
    double f() const { return precision + recall > 0 ? 2 * precision * recall / (precision + recall) : 0; }

    Strokes extra;   // what is drawn and not true
    Strokes missed;  // what is true and not drawn, in pixels of the drawing
};

// The truth may have another size: its display window is laid over the drawing's.  What lies outside the
// drawing's data window is not in view, and does not count.
Accuracy accuracy_of(const Strokes& drawing, const Strokes& truth, const AccuracyOptions& options);

}  // namespace keyline
