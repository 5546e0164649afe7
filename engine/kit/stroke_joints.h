// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/kit/strokes.h"

#include <vector>

namespace KEYLINE_API keyline {

// Strokes of one kind and owner whose ends go on in each other are one: those that meet at a point go on in
// the straightest one there, those with a gap between them where both point across it within `angle` degrees
// and it is at most `gap` pixels wide, and a third of the shorter one.  The best first; what would do equally
// well, by the strokes' order.
std::vector<Stroke> join_strokes(std::vector<Stroke> strokes, double gap, double angle);

// Loose ends that point at another stroke at most `reach` pixels ahead, twice that where they are straight,
// and a third of their own length, go on to it.
void meet_strokes(std::vector<Stroke>& strokes, double reach);

}  // namespace keyline
