// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/io/helper/helper.h"

#include <cstdint>

// What Keyline asks of its helper program for OpenEXR, which does with OpenEXR's C++ library what OpenEXRCore
// can't.  It opens no file: small OpenEXR files come with the request, samples or packed chunks go back.

namespace keyline::exr {

inline constexpr HelperProgram kHelperProgram{"keyline-exr-helper", "OpenEXR's library"};

// The rows of the request are those whose samples are wanted; of kPack, all.
enum class HelperTask : uint32_t {
    kUnpack,        // an OpenEXR file → its samples, row by row, channel by channel, at full resolution
    kUnpackAsRgba,  // a luminance/chroma file → half samples of A (where it has one), B, G, R
    kPackFirst = 0x100,  // + a compression: an uncompressed file of one chunk → that chunk, packed
};

// Enough for any sound file of this size that unpacks to `sample_bytes`.
inline HelperBounds bounds_of(uint64_t file_bytes, uint64_t sample_bytes) {
    const uint64_t bytes = file_bytes + sample_bytes;
    return {(uint64_t{256} << 20) + 10 * bytes, 10 + (bytes >> 22), bytes};
}

}  // namespace keyline::exr
