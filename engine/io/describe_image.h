// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/base/error.h"
#include "engine/io/describe.h"
#include "engine/io/image_source.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace KEYLINE_API keyline {

// One part of an image file as it is stored: every view, and deep ones too.
struct ImagePart {
    std::string name, view;          // empty where it has none
    std::vector<std::string> views;  // that its channels are of, where these are several
    std::string storage;             // "scanline", "tiled", "deep"; "" for formats other than OpenEXR
    std::string compression;         // by OpenEXR's name; "" where it is not known
    Rect display_window, data_window;
    int tile_width = 0, tile_height = 0;  // of a tiled part
    std::vector<FileChannel> channels;
    Metadata metadata;
};

struct ImageDescription {
    std::string format;  // "openexr", "png", …
    std::vector<ImagePart> parts;
    std::optional<Error> fault;  // what the headers do not tell: chunks that are not there
};

// What a file holds, from its headers.  Throws Failure (kInput) as open_image() does, but neither views nor
// deep parts are refused.
ImageDescription describe_image(const std::filesystem::path& file);

}  // namespace keyline
