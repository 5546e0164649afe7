// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/image.h"
#include "engine/metadata.h"

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace keyline {

struct ChannelInfo {
    std::string name;  // full: "ViewLayer.Combined.R"
    SampleType type = SampleType::kHalf;
    friend bool operator==(const ChannelInfo&, const ChannelInfo&) = default;
};

// Channels that are stored together (one part of a multi-part file), in a regular grid of chunks: cell
// (i, j) covers chunk_width × chunk_height pixels from window's corner on, cut at the window's edge.
struct ChannelGroup {
    std::vector<ChannelInfo> channels;
    Rect window;
    int chunk_width = 0, chunk_height = 0;

    int columns() const { return (window.width() + chunk_width - 1) / chunk_width; }
    int rows() const { return (window.height() + chunk_height - 1) / chunk_height; }
    Rect chunk(int column, int row) const {
        const int x = window.x0 + column * chunk_width, y = window.y0 + row * chunk_height;
        return intersect(window, {x, y, x + chunk_width, y + chunk_height});
    }
};

struct ImageHeader {
    Rect display_window;
    Rect data_window;  // the union of the groups' windows; outside its own group's a channel is 0
    std::vector<ChannelGroup> groups;
    Metadata metadata;
    std::string format;          // "openexr", "png", …
    std::filesystem::path file;  // as it was opened
};

// An open image.  Its header was read and found sound; pixels are decoded on demand.
class ImageSource {
public:
    virtual ~ImageSource() = default;

    virtual const ImageHeader& header() const = 0;

    // Decodes one chunk of a group and stores the samples of the wanted channels: `planes` has one entry a
    // channel of the group, in order and of the channel's type; those with null data are skipped.  Only the
    // part of the chunk inside a plane's rect is stored.  Safe from any number of threads at once.
    // Throws Failure (kInput) for a damaged chunk.
    virtual void read_chunk(std::size_t group, int column, int row, std::span<const Plane> planes) const = 0;

    // Bytes that one read_chunk of the group needs for itself while it runs (packed and unpacked buffers).
    virtual std::size_t chunk_memory(std::size_t group) const = 0;

    // Where the samples of a channel lie in memory already, over the group's whole window and with 64 bytes
    // that can be read behind the last: they are used in place, and read_chunk is not called.  Null data, as
    // for all files: nowhere.
    virtual Plane resident(std::size_t /*group*/, std::size_t /*channel*/) const { return {}; }

    // What decoding met that is worth a warning, once the frame is done.
    virtual std::vector<std::string> findings() const { return {}; }
};

struct OpenOptions {
    std::string part;                                    // name or index; empty: all of `view`
    std::string view;                                    // empty: the file's default view
    std::size_t max_chunk_bytes = std::size_t{1} << 29;  // a chunk that unpacks to more is refused
};

// Opens an image of any format, chosen by its content and then its extension.
// Throws Failure (kInput): not there, not an image, damaged, deep, no such part or view (listing those there
// are).  The message names the file.
std::unique_ptr<ImageSource> open_image(const std::filesystem::path& file, const OpenOptions& options = {});

}  // namespace keyline
