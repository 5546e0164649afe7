// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/io/exr/header.h"
#include "engine/io/image_source.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace keyline::exr {

// A part's channels as they are handed on: luminance and chroma become R G B, everything else is as stored,
// subsampled channels at full resolution.
struct DeliveredChannel {
    std::size_t index;  // in delivered_channels()
    ChannelInfo info;   // with the full name
};

// Which channels of which part are taken, and their names (GRAPH: "Layers and channels").
struct TakenPart {
    std::size_t index;
    std::vector<DeliveredChannel> channels;
};

// Whether the part is a luminance/chroma image: Y, and RY and BY of half its resolution, perhaps A.
bool is_luminance_chroma(const Part& part);

// What can be read from a part, under the names it has there.
std::vector<ChannelInfo> delivered_channels(const Part& part);

// Throws Failure (kInput): no such part or view (listing those there are), a deep part among those taken, two
// channels of one name.
std::vector<TakenPart> choose_parts(const std::string& file, std::span<const Part> parts,
                                    const OpenOptions& options);

}  // namespace keyline::exr
