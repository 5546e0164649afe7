// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/exr/chunk_table.h"

#include "engine/io/system_call.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <vector>

namespace keyline::exr {

namespace {

[[noreturn]] void not_finished(const InputFile& file, const std::string& why) {
    fail(ErrorKind::kInput, fmt::format("{}: the file is not finished: {}", file.name(), why),
         kUnfinishedHint, Passing::kUnfinished);
}

uint64_t chunk_count(const InputFile& file, const ReadContext& context, int part) {
    int32_t count = 0;
    if (exr_get_chunk_count(context.get(), part, &count) != EXR_ERR_SUCCESS || count < 0)
        fail(ErrorKind::kInput, fmt::format("{}: damaged header: no number of chunks", file.name()));
    return static_cast<uint64_t>(count);
}

std::vector<uint64_t> read_offsets(const InputFile& file, uint64_t at, uint64_t count) {
    if (at > file.size() || count > (file.size() - at) / sizeof(uint64_t))
        not_finished(file, fmt::format("it ends at byte {}, before the table of its {} chunks does",
                                       file.size(), count));
    std::vector<uint64_t> offsets(count);
    file.read(at, std::as_writable_bytes(std::span(offsets)));
    return offsets;
}

bool is_multipart(const InputFile& file) {
    std::array<std::byte, 8> start = {};
    file.read(0, start);
    return (get<uint32_t>(start, 4) & kMultipartFlag) != 0;
}

// Whether a chunk of a table holds rows of a region; of tiles, which have several sizes, any may.
bool may_hold(const Part& part, std::size_t chunk, const Rect& region) {
    if (part.storage == Storage::kDeep) return false;
    if (part.storage == Storage::kTiled) return true;
    const int64_t y = part.data_window.y0 + static_cast<int64_t>(chunk) * part.chunk_height;
    return y < region.y1 && y + part.chunk_height > region.y0;
}

// Of what stands before the data of a flat part's chunk: its part, its place, and last the data's size.
std::size_t head_bytes(const Part& part, bool multipart) {
    return (multipart ? 4U : 0U) + (part.storage == Storage::kTiled ? 16U : 4U) + 4U;
}

// Where a chunk ends; beyond any file where its head is not there.
uint64_t end_of_chunk(const InputFile& file, uint64_t offset, std::size_t head) {
    std::array<std::byte, 24> bytes = {};
    if (file.read_some(offset, std::span(bytes).first(head)) < head) return UINT64_MAX;
    return offset + head + get<uint32_t>(bytes, head - 4);
}

}  // namespace

void check_chunk_tables(const InputFile& file, const ReadContext& context, std::span<const Part> parts,
                        uint64_t tables, const Rect* region) {
    uint64_t chunks = 0, missing = 0, last = 0, at = tables;
    const Part* last_part = nullptr;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const std::vector<uint64_t> offsets =
            read_offsets(file, at, chunk_count(file, context, static_cast<int>(i)));
        at += offsets.size() * sizeof(uint64_t);
        for (std::size_t c = 0; c < offsets.size(); ++c) {
            if (region && !may_hold(parts[i], c, *region)) continue;
            ++chunks;
            missing += offsets[c] == 0 || offsets[c] >= file.size() ? 1 : 0;
            if (offsets[c] >= last) last_part = &parts[i];
            last = std::max(last, offsets[c]);
        }
    }
    if (missing > 0) not_finished(file, fmt::format("{} of {} chunks are not there", missing, chunks));
    if (!last_part || last_part->storage == Storage::kDeep) return;
    if (end_of_chunk(file, last, head_bytes(*last_part, is_multipart(file))) > file.size())
        not_finished(file, fmt::format("it ends at byte {}, in the middle of a chunk", file.size()));
}

bool has_chunks_in_line(const InputFile& file, const ReadContext& context, const Part& part,
                        uint64_t tables) {
    const uint64_t count = chunk_count(file, context, 0);
    const std::size_t head = head_bytes(part, is_multipart(file));
    uint64_t expected = tables + count * sizeof(uint64_t);
    int y = part.data_window.y0;
    for (const uint64_t offset : read_offsets(file, tables, count)) {
        std::array<std::byte, 4> row = {};
        if (offset != expected || file.read_some(offset, row) < row.size()) return false;
        if (part.storage == Storage::kScanline && get<int32_t>(row) != y) return false;
        expected = end_of_chunk(file, offset, head);
        y += part.chunk_height;
    }
    return expected == file.size();
}

}  // namespace keyline::exr
