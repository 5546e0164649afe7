// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace keyline {

// What the structure of a PNG, JPEG or TIFF file tells without decoding it, or loading a library for that:
// whether a folder of frames is finished is known in no time.

struct PictureSize {
    uint64_t width = 0, height = 0, channels = 0;
    friend bool operator==(const PictureSize&, const PictureSize&) = default;
};

// Whether the structure of a file of that extension can be followed so.
bool has_known_structure(const std::filesystem::path& file);

// Nothing where the file is cut short, or its structure is damaged.
std::optional<PictureSize> size_of_whole_picture(const std::filesystem::path& file);

}  // namespace keyline
