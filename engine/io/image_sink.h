// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/base/image.h"
#include "engine/base/metadata.h"
#include "engine/io/image_source.h"

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace KEYLINE_API keyline {

// What a sample of an output is stored as.
enum class Depth : uint8_t { kAuto, kHalf, kFloat, kUint8, kUint16 };

struct SinkSpec {
    Rect display_window;
    Rect data_window;                   // of the picture; formats without windows store the display window
    std::vector<ChannelInfo> channels;  // names and the types the engine would keep them in
    Metadata metadata;
    Depth depth = Depth::kAuto;
    std::string compression = "zip";
};

// One chunk of rows, ready to be put into the file.
struct EncodedChunk {
    int index = 0;  // chunks from the top, from 0
    std::vector<std::byte> bytes;
};

// An output being made.  Nothing is under its name before finish(); a sink destroyed earlier leaves nothing.
class ImageSink {
public:
    virtual ~ImageSink() = default;

    // The rows that the file stores: every chunk is `chunk_height` of them over the whole width, from
    // region().y0 on, cut at its end.
    virtual Rect region() const = 0;
    virtual int chunk_height() const = 0;

    // In which type encode() takes each channel (same order as in SinkSpec): what the engine must keep.
    virtual const std::vector<ChannelInfo>& channels() const = 0;

    // Where the samples of a channel are to be put, over the whole region; encode() is given parts of these
    // planes.  They hold zeros, which stay where a channel has no data.  Null data, as for all files:
    // wherever the engine likes.
    virtual Plane resident(std::size_t /*channel*/) const { return {}; }

    // Packs and compresses one chunk; `planes` holds a plane a channel, each covering the chunk.  Safe from
    // any number of threads at once.
    virtual EncodedChunk encode(int index, std::span<const Plane> planes) const = 0;

    // Appends to the file.  Called once a chunk, by one thread at a time, in increasing order of index.
    // Throws Failure (kOutput).
    virtual void commit(EncodedChunk chunk) = 0;

    // Checks that every chunk is there, syncs, and gives the file its name.  Throws Failure (kOutput).
    virtual void finish() = 0;
};

// What of an output is held until it is encoded, known before it is made: whole chunks of so many rows.
struct SinkShape {
    int chunk_rows = 0;
    std::size_t row_bytes = 0;
};
SinkShape sink_shape(const std::filesystem::path& file, const SinkSpec& spec);

// Starts an output; the format follows the extension.  Missing folders are made.
// Throws Failure: kOutput where the file can't be made, kGraph where the format can't hold what is asked
// (depth, channels, compression), naming what it can.
std::unique_ptr<ImageSink> create_image(const std::filesystem::path& file, const SinkSpec& spec);

// Throws what create_image() would for a format that can't hold what is asked, and makes nothing.
void check_image(const std::filesystem::path& file, const SinkSpec& spec);

// Whether `file` has the windows and channels of `spec` and, as far as its structure tells, is whole.
bool is_finished(const std::filesystem::path& file, const SinkSpec& spec);

// Removes the unfinished outputs in the folder of `file` that nobody is at work on any more.
void remove_leftovers(const std::filesystem::path& file);

}  // namespace keyline
