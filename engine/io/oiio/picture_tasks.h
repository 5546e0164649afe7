// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/metadata.h"
#include "engine/io/helper/helper.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

// What Keyline asks of its helper program for pictures, where OpenImageIO runs.  A session has one picture at
// a time, open to be read or being written.

namespace keyline::oiio {

inline constexpr HelperProgram kPictureHelper{"keyline-picture-helper", "OpenImageIO's library"};

enum class PictureTask : uint32_t {
    kOpen,   // a PictureRequest → the PictureHeader of what is open now
    kClose,  // what is open → nothing
    kRead,  // a Sample; rows of the picture → their samples, in the shared memory where they have room there
    kCreate,  // a PictureSpec and the file to write → nothing
    kWrite,   // rows of samples, in the bytes or else in the shared memory → nothing
    kFinish,  // → nothing: the file is whole
};

// What samples are in the rows that pass between the two.
enum class Sample : uint32_t { kUint8, kUint16, kHalf, kFloat };
std::size_t sample_bytes(Sample sample);

struct PictureRequest {
    std::string file;
    std::string part;         // by name or number; empty: the first
    bool to_be_read = false;  // else only the header is looked at, and found sound

    std::vector<std::byte> bytes() const;
    static PictureRequest from(std::span<const std::byte> bytes);
};

// A picture as OpenImageIO tells of it.
struct PictureHeader {
    std::string format;  // "png", …
    int32_t x = 0, y = 0, width = 0, height = 0;
    int32_t full_x = 0, full_y = 0, full_width = 0, full_height = 0;
    int32_t depth = 1, tile_height = 0;  // 0: no tiles
    int32_t strip_rows = 0;              // rows that are packed together; 0: not known
    int32_t alpha = -1;                  // the channel that the others are to be multiplied by; -1: none
    bool is_deep = false;
    Sample sample = Sample::kFloat;  // in which rows are had without a loss
    std::vector<std::string> channels;
    std::vector<std::string> types;  // of the channels in the file: "uint8", "float", …
    Metadata metadata;

    std::vector<std::byte> bytes() const;
    static PictureHeader from(std::span<const std::byte> bytes);
};

// A picture to be written.
struct PictureSpec {
    std::string file;    // for messages
    std::string format;  // "png", …
    int32_t width = 0, height = 0;
    int32_t alpha = -1;  // the channel; -1: none
    bool is_straight = false;
    int32_t tile_size = 0;  // 0: no tiles
    Sample sample = Sample::kFloat;
    std::vector<std::string> channels;
    std::string compression;  // empty: the format's own
    Metadata metadata;

    std::vector<std::byte> bytes() const;
    static PictureSpec from(std::span<const std::byte> bytes);
};

// What a sound picture may take; `bytes` is what its samples take as floats, 0 where that is not known yet.
HelperBounds bounds_of(uint64_t file_bytes, uint64_t bytes);

}  // namespace keyline::oiio
