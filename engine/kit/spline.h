// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/kit/strokes.h"

// Whittaker's smoothing: of all ways near the points the one that bends least.

namespace KEYLINE_API keyline {

// Moves the vertices onto the smooth way, and sets their curvature.  Deviations of about `noise` pixels are
// taken out; where there are larger ones it is the shape, and the way bends as the points do.  No vertex
// moves by more than 3 × noise.  Corners between straight arms stay, and so do ends that are joined to
// another line. `stiffness` scales the waves that are taken out: 1 is about 24 vertices.
void smooth(Stroke& stroke, double noise, double stiffness);

}  // namespace keyline
