// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/geometry.h"
#include "engine/base/metadata.h"
#include "engine/io/exr/format.h"
#include "engine/io/exr/header.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace keyline::exr {

// A file of one flat part, as it is written: magic number and header, the table of chunk offsets, the chunks.
struct Layout {
    Rect display_window, data_window;
    Compression compression = Compression::kNone;
    std::vector<StoredChannel> channels;  // sorted by name, as the format wants them
    Metadata metadata;
    bool one_tile = false;  // a tiled part whose only tile is the data window; else scanlines

    int rows_per_chunk() const {
        return one_tile ? std::max(1, data_window.height()) : info(compression).rows;
    }
    int chunks() const {
        const int rows = info(compression).rows;
        return one_tile ? 1 : (data_window.height() + rows - 1) / rows;
    }

    // Everything before the table of chunk offsets.  Attributes of the metadata that describe storage are
    // left out; pixelAspectRatio, screenWindowCenter and screenWindowWidth get their defaults where there are
    // none. Throws Failure (kOutput) for names that are too long and values that their type can't have.
    std::vector<std::byte> header() const;
};

}  // namespace keyline::exr
