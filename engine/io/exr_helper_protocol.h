// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

// What Keyline and its helper process say to each other over a socket, which is the helper's standard input.
// Request and reply are followed by their bytes; the helper ends when the socket is closed.

namespace keyline::exr {

enum class HelperTask : uint32_t {
    kUnpack,        // an OpenEXR file → its samples, row by row, channel by channel, at full resolution
    kUnpackAsRgba,  // a luminance/chroma file → half samples of A (where it has one), B, G, R
    kPackFirst = 0x100,  // + a compression: an uncompressed file of one chunk → that chunk, packed
};

struct HelperRequest {
    HelperTask task;
    int32_t first_row, rows;  // whose samples are wanted; of kPack, all
    uint32_t reserved;
    uint64_t file_bytes;
    uint64_t sample_bytes;  // of the whole file, unpacked; bounds the helper's memory and time
};

struct HelperReply {
    uint64_t succeeded;  // 1, or 0: the bytes are a message
    uint64_t bytes;
};

}  // namespace keyline::exr
