// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/node/node.h"

#include <optional>
#include <span>

// Where between two pixels one surface ends before another, by their normals.
//
// One sample a pixel, as of depth, says no more than that it is between their centres.  A renderer averages
// normals over the pixel: how much of both surfaces' normals the two pixels have is how much of both surfaces
// they show.

namespace keyline {

// As far as the normals on both sides are looked at, from the pixel before the edge.
inline constexpr int kUnmixReach = 3;

// An edge across a row (dx 1, dy 0) or a column (0, 1), between the pixel (x, y) and the next: how far it is
// from the first one's centre, about 0 to 1; nothing where both sides face alike, or where the two pixels are
// no mixture of them.
std::optional<double> unmixed_edge(std::span<const View> normals, int x, int y, int dx, int dy);

}  // namespace keyline
