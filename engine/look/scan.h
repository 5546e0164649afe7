// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/io/image_source.h"

#include <functional>
#include <span>
#include <vector>

// A picture passed over once, chunk by chunk, rows from the top.

namespace keyline {

// The wanted channels of a chunk; the planes of the others have no data.
struct ScannedChunk {
    Rect rect;
    std::span<const Plane> planes;  // one a channel of the group
};

// Visits every chunk of a group, or those that touch `region` cut to it.  `wanted` has an entry a channel.
void scan(const ImageSource& source, std::size_t group, const std::vector<bool>& wanted, const Rect& region,
          const std::function<void(const ScannedChunk&)>& visit);

// The samples of one row, whose values every type has exactly as doubles.
std::span<const double> row_of(const Plane& plane, int y, std::vector<double>& buffer);

// The bits of one row's samples of 32 bits.
std::span<const uint32_t> bits_of(const Plane& plane, int y, std::vector<uint32_t>& buffer);

}  // namespace keyline
