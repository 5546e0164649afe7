// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/exr/pack.h"

#include "engine/base/error.h"
#include "engine/io/exr/contained.h"
#include "engine/simd/predictor.h"

#include <cstring>
#include <fmt/format.h>
#include <libdeflate.h>
#include <new>

namespace keyline::exr {

namespace {

constexpr int kDeflateLevel = 2;

// Scratch memory that PIZ wants whatever the size of a chunk.
constexpr std::size_t kPizTables = std::size_t{3} << 19;

// What B44 makes of 4 × 4 samples of type half, which were 32 bytes.
constexpr std::size_t kB44Block = 14;

bool is_b44(Compression c) { return c == Compression::kB44 || c == Compression::kB44a; }

// A helper that packs, beside what a chunk needs: DWA's tables and its share of the library's pages.
constexpr std::size_t kPackingProcess = std::size_t{10} << 20;

void check(exr_result_t result) {
    if (result != EXR_ERR_SUCCESS)
        fail(ErrorKind::kOutput, fmt::format("can't be packed: {}", exr_get_default_error_message(result)));
}

std::vector<SampleType> types_of(const Layout& layout) {
    std::vector<SampleType> types;
    for (const StoredChannel& channel : layout.channels) types.push_back(channel.type);
    return types;
}

exr_pixel_type_t core_type(SampleType type) {
    return type == SampleType::kHalf    ? EXR_PIXEL_HALF
           : type == SampleType::kFloat ? EXR_PIXEL_FLOAT
                                        : EXR_PIXEL_UINT;
}

exr_attr_box2i_t to_box(const Rect& r) {
    exr_attr_box2i_t box = {};
    box.min.x = r.x0;
    box.min.y = r.y0;
    box.max.x = r.x1 - 1;
    box.max.y = r.y1 - 1;
    return box;
}

}  // namespace

// Delegating: what has been made is undone where a later step fails.
PackContext::PackContext(const Layout& layout) : PackContext() {
    exr_context_initializer_t init = EXR_DEFAULT_CONTEXT_INITIALIZER;
    init.error_handler_fn = [](exr_const_context_t, exr_result_t, const char*) {};
    init.write_fn = [](exr_const_context_t, void*, const void*, uint64_t size, uint64_t,
                       exr_stream_error_func_ptr_t) { return static_cast<int64_t>(size); };
    check(exr_start_write(&context_, "never written", EXR_WRITE_FILE_DIRECTLY, &init));
    int part = 0;
    check(exr_add_part(context_, "part", EXR_STORAGE_SCANLINE, &part));
    const exr_attr_box2i_t display = to_box(layout.display_window), data = to_box(layout.data_window);
    const exr_attr_v2f_t center = {};
    check(exr_initialize_required_attr(context_, part, &display, &data, 1, &center, 1,
                                       EXR_LINEORDER_INCREASING_Y,
                                       static_cast<exr_compression_t>(layout.compression)));
    for (const StoredChannel& channel : layout.channels)
        check(exr_add_channel(context_, part, channel.name.c_str(), core_type(channel.type),
                              EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1));
    check(exr_write_header(context_));
}

PackContext::~PackContext() { exr_finish(&context_); }

void Packer::FreeCompressor::operator()(libdeflate_compressor* compressor) const {
    libdeflate_free_compressor(compressor);
}

Packer::Packer(const Layout& layout, const PackContext* context)
    : layout_(layout),
      context_(context),
      block_(types_of(layout)),
      compressor_(libdeflate_alloc_compressor(kDeflateLevel)) {
    if (compressor_ == nullptr) throw std::bad_alloc();
}

Packer::~Packer() {
    if (has_pipeline_) exr_encoding_destroy(context_->get(), &pipeline_);
}

void Packer::pack(const Rect& rect, std::span<const Plane> planes, std::vector<std::byte>& out) {
    const std::span<const std::byte> bytes = compressed(rect, planes);
    append(out, int32_t{rect.y0});
    append(out, static_cast<int32_t>(bytes.size()));
    out.insert(out.end(), bytes.begin(), bytes.end());
}

std::span<const std::byte> Packer::compressed(const Rect& rect, std::span<const Plane> planes) {
    if (uses_core(layout_)) return packed_in_core(rect, planes);
    gather(rect, planes);
    if (layout_.compression == Compression::kNone) return samples_;
    return needs_helper(layout_.compression, layout_.channels) ? packed_in_helper(rect) : deflated();
}

bool Packer::uses_core(const Layout& layout) {
    const Compression c = layout.compression;
    return c != Compression::kNone && c != Compression::kZip && c != Compression::kZips &&
           !needs_helper(c, layout.channels);
}

void Packer::gather(const Rect& rect, std::span<const Plane> planes) {
    samples_.resize(block_.bytes(rect));
    for (std::size_t c = 0; c < planes.size(); ++c) {
        const std::size_t bytes = static_cast<std::size_t>(rect.width()) * sample_size(planes[c].type);
        for (int y = rect.y0; y < rect.y1; ++y)
            std::memcpy(samples_.data() + block_.offset(rect, c, y), planes[c].at(rect.x0, y), bytes);
    }
}

// What does not get smaller is stored as it is; the sizes tell a reader.
std::span<const std::byte> Packer::deflated() {
    split_.resize(samples_.size());
    packed_.resize(samples_.size() - 1);
    simd::split_and_difference(samples_.data(), split_.data(), samples_.size() / 2);
    const std::size_t n = libdeflate_zlib_compress(compressor_.get(), split_.data(), split_.size(),
                                                   packed_.data(), packed_.size());
    return n == 0 ? std::span<const std::byte>(samples_) : std::span<const std::byte>(packed_).first(n);
}

// Without a function to write with, the pipeline packs and compresses only.
std::span<const std::byte> Packer::packed_in_core(const Rect& rect, std::span<const Plane> planes) {
    exr_chunk_info_t chunk = {};
    check(exr_write_scanline_chunk_info(context_->get(), 0, rect.y0, &chunk));
    if (has_pipeline_) {
        check(exr_encoding_update(context_->get(), 0, &chunk, &pipeline_));
    } else {
        check(exr_encoding_initialize(context_->get(), 0, &chunk, &pipeline_));
        has_pipeline_ = true;
    }
    for (std::size_t c = 0; c < planes.size(); ++c) {
        exr_coding_channel_info_t& channel = pipeline_.channels[c];
        channel.encode_from_ptr = reinterpret_cast<const uint8_t*>(planes[c].at(rect.x0, rect.y0));
        channel.user_bytes_per_element = static_cast<int16_t>(sample_size(planes[c].type));
        channel.user_data_type = static_cast<uint16_t>(core_type(planes[c].type));
        channel.user_pixel_stride = static_cast<int32_t>(sample_size(planes[c].type));
        channel.user_line_stride = static_cast<int32_t>(planes[c].stride);
    }
    check(exr_encoding_choose_default_routines(context_->get(), 0, &pipeline_));
    pipeline_.write_fn = nullptr;
    pipeline_.yield_until_ready_fn = nullptr;
    check(exr_encoding_run(context_->get(), 0, &pipeline_));
    const bool smaller = pipeline_.compressed_bytes < pipeline_.packed_bytes;
    return {static_cast<const std::byte*>(smaller ? pipeline_.compressed_buffer : pipeline_.packed_buffer),
            smaller ? pipeline_.compressed_bytes : pipeline_.packed_bytes};
}

// The helper is sent the chunk as a file of its own, unpacked.
std::span<const std::byte> Packer::packed_in_helper(const Rect& rect) {
    Layout unpacked = layout_;
    unpacked.display_window = unpacked.data_window = rect;
    unpacked.compression = Compression::kNone;
    unpacked.metadata = {};
    std::vector<std::byte> chunks;
    const std::size_t row = block_.pixel_bytes() * static_cast<std::size_t>(rect.width());
    chunks.reserve(static_cast<std::size_t>(rect.height()) * (row + 2 * sizeof(int32_t)));
    for (int y = rect.y0; y < rect.y1; ++y) {
        append(chunks, int32_t{y});
        append(chunks, static_cast<uint32_t>(row));
        const auto bytes = std::span(samples_).subspan(static_cast<std::size_t>(y - rect.y0) * row, row);
        chunks.insert(chunks.end(), bytes.begin(), bytes.end());
    }
    HelperRequest request = {};
    request.task = static_cast<uint32_t>(HelperTask::kPackFirst) + static_cast<uint32_t>(layout_.compression);
    const std::vector<std::byte> file = file_of(unpacked, chunks);
    try {
        packed_ = helper_.run(request, bounds_of(file.size(), samples_.size()), file);
    } catch (const Failure& failure) {
        fail(ErrorKind::kOutput, fmt::format("rows {} to {} can't be packed as {}: {}", rect.y0, rect.y1 - 1,
                                             info(layout_.compression).name, failure.error().what));
    }
    return packed_;
}

std::size_t Packer::memory(const Layout& layout) {
    const int rows = std::min(layout.rows_per_chunk(), layout.data_window.height());
    const std::size_t bytes = BlockLayout(types_of(layout)).bytes({0, 0, layout.data_window.width(), rows});
    if (layout.compression == Compression::kNone) return bytes;
    // Here: the samples, and the small file on its way out and back.  There, as measured: 2.4 times the
    // samples of type half, 4.1 times those of float.
    const bool has_float = std::ranges::any_of(
        layout.channels, [](const StoredChannel& c) { return c.type == SampleType::kFloat; });
    if (needs_helper(layout.compression, layout.channels))
        return (4 + (has_float ? 5 : 3)) * bytes + kPackingProcess;
    if (is_b44(layout.compression)) return bytes + 2 * most_packed(layout);
    if (uses_core(layout)) return 3 * bytes + (layout.compression == Compression::kPiz ? kPizTables : 0);
    return 3 * bytes;
}

std::size_t Packer::most_packed(const Layout& layout) {
    const int rows = std::min(layout.rows_per_chunk(), layout.data_window.height());
    const std::size_t width = static_cast<std::size_t>(layout.data_window.width());
    std::size_t sum = 0;
    for (const StoredChannel& c : layout.channels)
        sum += is_b44(layout.compression) && c.type == SampleType::kHalf
                   ? (width + 3) / 4 * ((static_cast<std::size_t>(rows) + 3) / 4) * kB44Block
                   : width * static_cast<std::size_t>(rows) * sample_size(c.type);
    return sum;
}

}  // namespace keyline::exr
