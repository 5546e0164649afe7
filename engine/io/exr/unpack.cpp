// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/exr/unpack.h"

#include "engine/base/error.h"
#include "engine/simd/predictor.h"

#include <cstring>
#include <fmt/format.h>
#include <libdeflate.h>

namespace keyline::exr {

namespace {

void check(exr_result_t result) {
    if (result != EXR_ERR_SUCCESS) fail(ErrorKind::kInput, exr_get_default_error_message(result));
}

bool is_deflated(Compression compression) {
    return compression == Compression::kZip || compression == Compression::kZips;
}

// Scratch memory that PIZ wants whatever the size of a chunk.
constexpr std::size_t kPizTables = std::size_t{1} << 20;

}  // namespace

void store(const Block& block, const BlockLayout& layout, std::size_t channel, const Plane& plane) {
    const Rect wanted = intersect(block.rect, plane.rect);
    const std::size_t size = sample_size(plane.type);
    const std::size_t bytes = static_cast<std::size_t>(wanted.width()) * size;
    for (int y = wanted.y0; y < wanted.y1; ++y) {
        const std::size_t offset = layout.offset(block.rect, channel, y) +
                                   static_cast<std::size_t>(wanted.x0 - block.rect.x0) * size;
        if (block.split) {
            const std::byte* even = block.samples.data() + offset / 2;
            simd::join_bytes(even, even + block.samples.size() / 2, plane.at(wanted.x0, y), bytes / 2);
        } else {
            std::memcpy(plane.at(wanted.x0, y), block.samples.data() + offset, bytes);
        }
    }
}

void ChunkUnpacker::FreeDecompressor::operator()(libdeflate_decompressor* decompressor) const {
    libdeflate_free_decompressor(decompressor);
}

ChunkUnpacker::ChunkUnpacker(const InputFile& file, const ReadContext& context, const Part& part,
                             int part_index)
    : file_(file),
      context_(context),
      part_(part),
      part_index_(part_index),
      layout_(part.types()),
      decompressor_(libdeflate_alloc_decompressor()) {
    if (decompressor_ == nullptr) throw std::bad_alloc();
}

ChunkUnpacker::~ChunkUnpacker() {
    if (has_pipeline_) exr_decoding_destroy(context_.get(), &pipeline_);
}

Block ChunkUnpacker::unpack(const Rect& rect) {
    const exr_chunk_info_t chunk = find_chunk(context_, part_, part_index_, rect);
    const std::size_t size = layout_.bytes(rect);
    const bool as_is = chunk.packed_size == size;  // what did not get smaller is stored unpacked
    if (!as_is && !is_deflated(part_.compression)) return unpack_in_core(chunk, rect);
    packed_.resize(chunk.packed_size);
    file_.read(chunk.data_offset, packed_);
    return as_is ? Block{rect, packed_} : inflate(packed_, rect);
}

Block ChunkUnpacker::inflate(std::span<const std::byte> packed, const Rect& rect) {
    unpacked_.resize(layout_.bytes(rect));
    const libdeflate_result result = libdeflate_zlib_decompress(
        decompressor_.get(), packed.data(), packed.size(), unpacked_.data(), unpacked_.size(), nullptr);
    if (result != LIBDEFLATE_SUCCESS)
        fail(ErrorKind::kInput,
             fmt::format("{} bytes of deflated data do not unpack to {}", packed.size(), unpacked_.size()));
    simd::undo_difference(unpacked_.data(), unpacked_.size());
    return {rect, unpacked_, true};
}

// The pipeline only reads and decompresses: the samples are copied out by store().
Block ChunkUnpacker::unpack_in_core(const exr_chunk_info_t& chunk, const Rect& rect) {
    if (part_.compression == Compression::kNone)
        fail(ErrorKind::kInput,
             fmt::format("{} bytes where {} were expected", chunk.packed_size, layout_.bytes(rect)));
    if (has_pipeline_) {
        check(exr_decoding_update(context_.get(), part_index_, &chunk, &pipeline_));
    } else {
        check(exr_decoding_initialize(context_.get(), part_index_, &chunk, &pipeline_));
        has_pipeline_ = true;
        check(exr_decoding_choose_default_routines(context_.get(), part_index_, &pipeline_));
        pipeline_.unpack_and_convert_fn = nullptr;
    }
    check(exr_decoding_run(context_.get(), part_index_, &pipeline_));
    return {rect, {static_cast<const std::byte*>(pipeline_.unpacked_buffer), layout_.bytes(rect)}};
}

std::size_t ChunkUnpacker::memory(const Part& part, std::size_t packed) {
    const Rect chunk{0, 0, part.chunk_width, part.chunk_height};
    const std::size_t unpacked = BlockLayout(part.types()).bytes(chunk);
    if (is_deflated(part.compression) || part.compression == Compression::kNone)
        return unpacked + std::min(packed, unpacked);
    return 3 * unpacked + (part.compression == Compression::kPiz ? kPizTables : 0);
}

exr_chunk_info_t find_chunk(const ReadContext& context, const Part& part, int part_index, const Rect& rect) {
    exr_chunk_info_t chunk = {};
    if (part.storage == Storage::kTiled) {
        const int column = (rect.x0 - part.data_window.x0) / part.chunk_width;
        const int row = (rect.y0 - part.data_window.y0) / part.chunk_height;
        check(exr_read_tile_chunk_info(context.get(), part_index, column, row, 0, 0, &chunk));
    } else {
        check(exr_read_scanline_chunk_info(context.get(), part_index, rect.y0, &chunk));
    }
    return chunk;
}

}  // namespace keyline::exr
