// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/exr/contained.h"

#include "engine/base/error.h"
#include "engine/io/exr/parts.h"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>

namespace keyline::exr {

namespace {

// OpenEXR's filter for chroma looks 13 rows up and down, and once more by one to limit saturation.
constexpr int kChromaMargin = 16;

// Rows to hand to the helper at once, where chunks are small.
constexpr int kLeastRows = 64;

int leader_bytes(const Layout& layout) { return layout.one_tile ? 20 : 8; }

}  // namespace

bool needs_helper(Compression compression, std::span<const StoredChannel> channels) {
    if (compression == Compression::kDwaa || compression == Compression::kDwab) return true;
    const bool is_b44 = compression == Compression::kB44 || compression == Compression::kB44a;
    return is_b44 &&
           std::ranges::any_of(channels, [](const auto& c) { return c.type == SampleType::kFloat; });
}

std::vector<std::byte> file_of(const Layout& layout, std::span<const std::byte> chunks) {
    std::vector<std::byte> file = layout.header();
    const std::size_t first_chunk =
        file.size() + static_cast<std::size_t>(layout.chunks()) * sizeof(uint64_t);
    const auto leader = static_cast<std::size_t>(leader_bytes(layout));
    for (std::size_t at = 0; at < chunks.size(); at += leader + get<uint32_t>(chunks, at + leader - 4))
        append(file, uint64_t{first_chunk + at});
    file.insert(file.end(), chunks.begin(), chunks.end());
    return file;
}

ContainedUnpacker::ContainedUnpacker(const InputFile& file, const ReadContext& context, const Part& part,
                                     int part_index)
    : file_(file),
      context_(context),
      part_(part),
      part_index_(part_index),
      as_rgba_(is_luminance_chroma(part)),
      stored_(part.types()) {}

bool ContainedUnpacker::is_for(const Part& part) {
    return part.subsampled() || needs_helper(part.compression, part.channels);
}

// Whole chunks, and whole samples of every channel.
int ContainedUnpacker::block_rows(const Part& part) {
    if (part.storage == Storage::kTiled || !part.subsampled()) return part.chunk_height;
    int rows = info(part.compression).rows;
    for (const StoredChannel& channel : part.channels) rows = std::lcm(rows, channel.y_sampling);
    rows *= (kLeastRows + rows - 1) / rows;
    return std::min(rows, part.data_window.height());
}

std::size_t ContainedUnpacker::memory(const Part& part) {
    const bool is_chroma = is_luminance_chroma(part);
    const int rows = block_rows(part) + (is_chroma ? 4 * kChromaMargin : 0);
    const std::size_t bytes = BlockLayout(part.types()).bytes({0, 0, part.chunk_width, rows});
    // Three times here, the rest in the helper.
    return (is_chroma ? 8 : 6) * bytes + kHelperProcess;
}

Block ContainedUnpacker::unpack(const Rect& rect) {
    Rect rows = rect;
    if (as_rgba_) {
        const int chunk = info(part_.compression).rows;
        const int margin = (kChromaMargin + chunk - 1) / chunk * chunk;
        rows = intersect(part_.data_window, grow(rect, {0, margin}));
    }
    HelperRequest request = {};
    request.task = static_cast<uint32_t>(as_rgba_ ? HelperTask::kUnpackAsRgba : HelperTask::kUnpack);
    request.first_row = rect.y0;
    request.rows = rect.height();
    const std::vector<std::byte> file = small_file(rows);
    samples_ = helper_.run(request, bounds_of(file.size(), stored_.bytes(rows)), file);
    std::size_t pixel_bytes = 0;
    for (const ChannelInfo& channel : delivered_channels(part_)) pixel_bytes += sample_size(channel.type);
    if (samples_.size() != pixel_bytes * static_cast<std::size_t>(rect.area()))
        fail(ErrorKind::kInput, fmt::format("{} bytes of samples in place of {}", samples_.size(),
                                            pixel_bytes * static_cast<std::size_t>(rect.area())));
    return {rect, samples_};
}

std::vector<std::byte> ContainedUnpacker::small_file(const Rect& rect) const {
    Layout layout;
    layout.display_window = layout.data_window = rect;
    layout.compression = part_.compression;
    layout.channels = part_.channels;
    layout.one_tile = part_.storage == Storage::kTiled;
    // What luminance is made of depends on them.
    if (const Attribute* chromaticities = part_.metadata.find("chromaticities"))
        layout.metadata.set(*chromaticities);
    std::vector<std::byte> chunks;
    const int rows = layout.rows_per_chunk();
    for (int y = rect.y0; y < rect.y1; y += rows)
        append_chunk(intersect(rect, {rect.x0, y, rect.x1, y + rows}), chunks);
    return file_of(layout, chunks);
}

void ContainedUnpacker::append_chunk(const Rect& rect, std::vector<std::byte>& chunks) const {
    const exr_chunk_info_t chunk = find_chunk(context_, part_, part_index_, rect);
    if (part_.storage == Storage::kTiled)
        for (int i = 0; i < 4; ++i) append(chunks, int32_t{0});  // the tile's place and level
    else
        append(chunks, int32_t{rect.y0});
    append(chunks, static_cast<uint32_t>(chunk.packed_size));
    const std::size_t at = chunks.size();
    chunks.resize(at + chunk.packed_size);
    file_.read(chunk.data_offset, std::span(chunks).subspan(at));
}

}  // namespace keyline::exr
