// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/geometry.h"
#include "engine/base/image.h"
#include "engine/io/exr/format.h"
#include "engine/io/exr/header.h"

#include <cstddef>
#include <memory>
#include <openexr.h>
#include <span>
#include <vector>

struct libdeflate_decompressor;

namespace keyline::exr {

// The samples of one chunk, still in the file's order.  Split: bytes at even places first, those at odd ones
// in the second half, as ZIP leaves them; joining them while they are copied out saves a pass.
struct Block {
    Rect rect;
    std::span<const std::byte> samples;
    bool split = false;
};

// Copies the part of a block that a plane wants; `channel` counts in the layout.
void store(const Block& block, const BlockLayout& layout, std::size_t channel, const Plane& plane);

// Reads and unpacks blocks of one part, one at a time, in buffers that are kept.
class Unpacker {
public:
    Unpacker() = default;
    virtual ~Unpacker() = default;
    Unpacker(const Unpacker&) = delete;
    Unpacker& operator=(const Unpacker&) = delete;

    // The block of `rect`, which lives until the next call.
    // Throws Failure (kInput), the message without file and place.
    virtual Block unpack(const Rect& rect) = 0;
};

// Chunk by chunk, for every compression that OpenEXRCore (3.1.5) gets right: not DWA, not B44 with float
// channels; and for parts without subsampled channels.
class ChunkUnpacker final : public Unpacker {
public:
    ChunkUnpacker(const InputFile& file, const ReadContext& context, const Part& part, int part_index);
    ~ChunkUnpacker() override;
    ChunkUnpacker(const ChunkUnpacker&) = delete;
    ChunkUnpacker& operator=(const ChunkUnpacker&) = delete;

    // `rect`: a chunk.
    Block unpack(const Rect& rect) override;

    // Bytes that unpack() may need for chunks of the part that are `packed` bytes large in the file.
    static std::size_t memory(const Part& part, std::size_t packed);

private:
    Block inflate(std::span<const std::byte> packed, const Rect& rect);
    Block unpack_in_core(const exr_chunk_info_t& chunk, const Rect& rect);

    struct FreeDecompressor {
        void operator()(libdeflate_decompressor* decompressor) const;
    };

    const InputFile& file_;
    const ReadContext& context_;
    const Part& part_;
    int part_index_;
    BlockLayout layout_;
    std::vector<std::byte> packed_, unpacked_;
    std::unique_ptr<libdeflate_decompressor, FreeDecompressor> decompressor_;
    exr_decode_pipeline_t pipeline_ = {};
    bool has_pipeline_ = false;
};

// Where a chunk lies, as Core reads and checks it.  Throws Failure (kInput), the message without file and
// place.
exr_chunk_info_t find_chunk(const ReadContext& context, const Part& part, int part_index, const Rect& rect);

}  // namespace keyline::exr
