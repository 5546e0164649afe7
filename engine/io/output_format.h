// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/io/image_sink.h"
#include "engine/io/sink_memory.h"

#include <cstddef>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// What pictures of formats other than OpenEXR can hold.  It is told here, beside the library that writes
// them, so that a graph is checked without loading it.

namespace keyline {

// Rows that are encoded at once: the tile of the one format that must have tiles.
inline constexpr int kPictureChunkRows = 64;

// What an output format holds.
struct OutputFormat {
    std::string_view name = {};  // OpenImageIO's
    std::vector<std::string_view> extensions = {};
    std::vector<Depth> depths = {};  // the best first
    std::vector<std::string_view> channel_sets =
        {};                       // of "Y", "YA", "RGB", "RGBA"; "Y" is any single channel
    bool more_channels = false;   // any others after R G B (A), without their names
    bool straight_alpha = false;  // R G B are not multiplied by A in the file
    bool tiled = false;           // and in no other way
    std::vector<std::string_view> compressions = {};  // the default first; empty: no choice
    bool has_quality = false;                         // the first compression takes one, "jpeg:90", 1 to 100
    int least_pixels = 1, most_pixels = std::numeric_limits<int>::max();  // of width and of height
    double frames_held = 0;  // how many times over its writer holds the frame, in the file's depth; measured

    bool holds(std::string_view channel_set) const;
};

// Channels in the order of a file, as indices into those given.
struct ChannelOrder {
    std::vector<std::size_t> channels;
    std::optional<std::size_t> alpha;  // its place in `channels`
};

// How a picture is stored.
struct PictureLayout {
    const OutputFormat& format;
    ChannelOrder order;
    Depth depth = Depth::kAuto;  // never auto
    std::string compression;     // empty: the format's own
};

// Throws Failure (kGraph) where the format of the file's name can't hold what is asked, naming what it can.
PictureLayout picture_layout(const std::filesystem::path& file, const SinkSpec& spec);

// What writing `spec` needs.  Throws as picture_layout().
SinkMemory picture_memory(const std::filesystem::path& file, const SinkSpec& spec);

// Without its dot, in small letters.
std::string extension_of(const std::filesystem::path& file);

// "a b c"
std::string spaced(const std::vector<std::string>& words);

}  // namespace keyline
