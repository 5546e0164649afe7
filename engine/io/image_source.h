// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/base/digest.h"
#include "engine/base/image.h"
#include "engine/base/metadata.h"

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace KEYLINE_API keyline {

struct ChannelInfo {
    std::string name;  // full: "ViewLayer.Combined.R"
    SampleType type = SampleType::kHalf;
    bool exact = false;  // of an output: ids, which are stored in this type or not at all
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

    // Bytes that the source keeps from the first read_chunk to its end, however many threads call it.
    virtual std::size_t held_memory() const { return 0; }

    // Where the samples of a channel lie in memory already, over the group's whole window and with 64 bytes
    // that can be read behind the last: they are used in place, and read_chunk is not called.  Null data, as
    // for all files: nowhere.
    virtual Plane resident(std::size_t /*group*/, std::size_t /*channel*/) const { return {}; }

    // What decoding met that is worth a warning, among the samples demanded: `demanded` has a region a
    // channel, group after group.  It does not depend on what else was decoded, nor on how often.
    virtual std::vector<std::string> findings(std::span<const Rect> /*demanded*/) const { return {}; }

    // Of what it delivers: the file as it was when it was opened, and what was taken of it.
    virtual Digest digest() const { return digest_; }
    void set_digest(const Digest& digest) { digest_ = digest; }

    // Gives back what decoding holds for itself, since nobody decodes for now.  False where that can't be
    // done: such a source is opened anew for every frame.
    virtual bool rest() const { return false; }

private:
    Digest digest_;
};

// A source that is a file, which open_image() names.
class FileSource : public ImageSource {
public:
    const ImageHeader& header() const final { return header_; }
    void set_file(std::filesystem::path file) { header_.file = std::move(file); }

protected:
    ImageHeader header_;
};

struct OpenOptions {
    std::string part;                                    // name or index; empty: all of `view`
    std::string view;                                    // empty: the file's default view
    std::size_t max_chunk_bytes = std::size_t{1} << 29;  // a chunk that unpacks to more is refused
};

// What open_image() would take now, as its digest; unknown where there is no such file.
Digest image_digest(const std::filesystem::path& file, const OpenOptions& options);

// Opens an image of any format, chosen by its content and then its extension.
// Throws Failure (kInput): not there, not an image, damaged, deep, no such part or view (listing those there
// are).  The message names the file.
std::unique_ptr<ImageSource> open_image(const std::filesystem::path& file, const OpenOptions& options = {});

}  // namespace keyline
