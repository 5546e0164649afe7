// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/error.h"
#include "engine/io/image_source.h"
#include "tests/io/exr_files.h"

#include <algorithm>
#include <filesystem>
#include <vector>

namespace keyline {

// Opens an image and reads some chunks of every group, into memory of the chunk's own size.
inline void read_some(const std::filesystem::path& file) {
    constexpr int64_t kMostChunks = 40;
    const auto source = open_image(file);
    for (std::size_t g = 0; g < source->header().groups.size(); ++g) {
        const ChannelGroup& group = source->header().groups[g];
        const int64_t chunks = int64_t{group.columns()} * group.rows();
        for (int64_t i = 0; i < std::min(chunks, kMostChunks); ++i) {
            const auto column = static_cast<int>(i % group.columns()),
                       row = static_cast<int>(i / group.columns());
            std::vector<Pixels> pixels;
            std::vector<Plane> planes;
            for (const ChannelInfo& c : group.channels) {
                Rect rect = group.chunk(column, row);
                rect.x1 = std::min(rect.x1, rect.x0 + 1000);
                planes.push_back(pixels.emplace_back(c.type, rect).plane());
            }
            source->read_chunk(g, column, row, planes);
        }
    }
}

// An error of reading names the file, and is of the input.
inline bool is_of_input(const Error& error) {
    return error.kind == ErrorKind::kInput && error.what.find("damaged.") != std::string::npos;
}

}  // namespace keyline
