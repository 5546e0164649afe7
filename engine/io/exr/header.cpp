// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/exr/header.h"

#include "engine/base/error.h"
#include "engine/base/index.h"
#include "engine/io/exr/metadata.h"

#include <algorithm>
#include <exception>
#include <fmt/format.h>

namespace keyline::exr {

struct ReadContext::Stream {
    const InputFile* file;
    std::string first_message;  // only of the headers, which one thread reads
    bool open = false;
};

namespace {

template <class Stream>
Stream* stream_of(exr_const_context_t context) {
    void* data = nullptr;
    return exr_get_user_data(context, &data) == EXR_ERR_SUCCESS ? static_cast<Stream*>(data) : nullptr;
}

// In a file that has deep parts beside flat ones, Core (3.1.5) wants of the flat ones what only deep ones
// have. It knows by their type which are which; the flag in the file's version says nothing more.
void hide_deep_flag(std::span<std::byte> start_of_file) {
    if (start_of_file.size() < 8) return;
    const auto version = get<uint32_t>(start_of_file, 4);
    if ((version & kMultipartFlag) == 0) return;
    const uint32_t shown = version & ~kDeepFlag;
    std::memcpy(start_of_file.data() + 4, &shown, sizeof shown);
}

[[noreturn]] void damaged(const InputFile& file, const std::string& why) {
    file.fail_where_the_system_did();
    fail(ErrorKind::kInput, fmt::format("{}: damaged header: {}", file.name(), why));
}

Rect from_box(const exr_attr_box2i_t& box, const char* what, const InputFile& file) {
    const int most = kMaxCoordinate;
    if (box.min.x > box.max.x || box.min.y > box.max.y || box.min.x < -most || box.min.y < -most ||
        box.max.x >= most || box.max.y >= most)
        damaged(file, fmt::format("the {} is ({}, {}) to ({}, {}); it must not be empty nor leave ±{}", what,
                                  box.min.x, box.min.y, box.max.x, box.max.y, most));
    return {box.min.x, box.min.y, box.max.x + 1, box.max.y + 1};
}

// The calls to Core that read what a header says; each fails only for a damaged one.
class PartReader {
public:
    PartReader(const InputFile& file, exr_const_context_t context, int index)
        : file_(file), context_(context), index_(index) {}

    Part read(std::vector<Attribute> attributes) const {
        Part part;
        read_storage(part);
        read_windows(part);
        read_channels(part);
        read_chunk_size(part);
        part.name = text_of(attributes, "name").value_or("");
        part.view = text_of(attributes, "view").value_or("");
        for (Attribute& attribute : attributes) {
            const auto* views = std::get_if<std::vector<std::string>>(&attribute.value);
            if (attribute.name == "multiView" && views != nullptr) part.views = *views;
            if (!describes_storage(attribute.name)) part.metadata.set(std::move(attribute));
        }
        return part;
    }

private:
    void check(exr_result_t result) const {
        if (result != EXR_ERR_SUCCESS) damaged(file_, exr_get_default_error_message(result));
    }

    void read_storage(Part& part) const {
        exr_storage_t storage = EXR_STORAGE_LAST_TYPE;
        check(exr_get_storage(context_, index_, &storage));
        part.storage = storage == EXR_STORAGE_SCANLINE ? Storage::kScanline
                       : storage == EXR_STORAGE_TILED  ? Storage::kTiled
                                                       : Storage::kDeep;
        exr_compression_t compression = EXR_COMPRESSION_LAST_TYPE;
        check(exr_get_compression(context_, index_, &compression));
        if (static_cast<std::size_t>(compression) >= kCompressions.size())
            damaged(file_, fmt::format("unknown compression {}", static_cast<int>(compression)));
        part.compression = static_cast<Compression>(compression);
    }

    void read_windows(Part& part) const {
        exr_attr_box2i_t box = {};
        check(exr_get_data_window(context_, index_, &box));
        part.data_window = from_box(box, "data window", file_);
        check(exr_get_display_window(context_, index_, &box));
        part.display_window = from_box(box, "display window", file_);
    }

    void read_channels(Part& part) const {
        const exr_attr_chlist_t* list = nullptr;
        check(exr_get_channels(context_, index_, &list));
        for (int i = 0; i < list->num_channels; ++i) {
            const exr_attr_chlist_entry_t& entry = list->entries[i];
            if (entry.x_sampling < 1 || entry.y_sampling < 1 || entry.pixel_type >= EXR_PIXEL_LAST_TYPE)
                damaged(file_,
                        fmt::format("channel {} has type {} and sampling {} × {}", in_quotes(entry.name.str),
                                    static_cast<int>(entry.pixel_type), entry.x_sampling, entry.y_sampling));
            part.channels.push_back({{entry.name.str, static_cast<std::size_t>(entry.name.length)},
                                     entry.pixel_type == EXR_PIXEL_HALF    ? SampleType::kHalf
                                     : entry.pixel_type == EXR_PIXEL_FLOAT ? SampleType::kFloat
                                                                           : SampleType::kUint,
                                     entry.x_sampling,
                                     entry.y_sampling,
                                     entry.p_linear});
            const Rect& window = part.data_window;
            if (window.x0 % entry.x_sampling != 0 || window.width() % entry.x_sampling != 0 ||
                window.y0 % entry.y_sampling != 0 || window.height() % entry.y_sampling != 0)
                damaged(file_,
                        fmt::format("channel {} has sampling {} × {}, which the data window's corner or "
                                    "size is no multiple of",
                                    in_quotes(entry.name.str), entry.x_sampling, entry.y_sampling));
        }
        if (part.channels.empty()) damaged(file_, "a part without channels");
    }

    void read_chunk_size(Part& part) const {
        const Rect& window = part.data_window;
        part.chunk_width = window.width();
        part.chunk_height = std::min(window.height(), info(part.compression).rows);
        if (part.storage != Storage::kTiled) return;
        uint32_t width = 0, height = 0;
        exr_tile_level_mode_t levels = EXR_TILE_LAST_TYPE;
        exr_tile_round_mode_t rounding = EXR_TILE_ROUND_LAST_TYPE;
        check(exr_get_tile_descriptor(context_, index_, &width, &height, &levels, &rounding));
        if (width == 0 || height == 0) damaged(file_, fmt::format("tiles of {} × {} pixels", width, height));
        if (part.subsampled()) damaged(file_, "tiles with subsampled channels");
        part.chunk_width = static_cast<int>(std::min<uint32_t>(width, static_cast<uint32_t>(window.width())));
        part.chunk_height =
            static_cast<int>(std::min<uint32_t>(height, static_cast<uint32_t>(window.height())));
    }

    const InputFile& file_;
    exr_const_context_t context_;
    int index_;
};

}  // namespace

ReadContext::ReadContext(const InputFile& file) : stream_(new Stream{&file, {}}) {
    exr_context_initializer_t init = EXR_DEFAULT_CONTEXT_INITIALIZER;
    init.user_data = stream_.get();
    init.error_handler_fn = [](exr_const_context_t context, exr_result_t, const char* message) {
        auto* stream = context == nullptr ? nullptr : stream_of<Stream>(context);
        if (stream != nullptr && !stream->open && stream->first_message.empty())
            stream->first_message = message;
    };
    init.size_fn = [](exr_const_context_t, void* stream) {
        return static_cast<int64_t>(static_cast<Stream*>(stream)->file->size());
    };
    init.read_fn = [](exr_const_context_t, void* stream, void* buffer, uint64_t size, uint64_t offset,
                      exr_stream_error_func_ptr_t) -> int64_t {
        try {
            const std::span<std::byte> bytes(static_cast<std::byte*>(buffer), size);
            const std::size_t n = static_cast<Stream*>(stream)->file->read_some(offset, bytes);
            if (offset == 0) hide_deep_flag(bytes.first(n));
            return static_cast<int64_t>(n);
        } catch (const std::exception&) {  // Core is C: the fault becomes its own "can't read"
            return -1;
        }
    };
    init.flags = EXR_CONTEXT_FLAG_DISABLE_CHUNK_RECONSTRUCTION;
    const exr_result_t result = exr_start_read(&context_, file.name().c_str(), &init);
    if (result != EXR_ERR_SUCCESS)
        damaged(file, stream_->first_message.empty() ? exr_get_default_error_message(result)
                                                     : stream_->first_message);
    stream_->open = true;
}

ReadContext::~ReadContext() { exr_finish(&context_); }

bool Part::subsampled() const { return std::ranges::any_of(channels, &StoredChannel::subsampled); }

std::vector<SampleType> Part::types() const {
    std::vector<SampleType> types;
    for (const StoredChannel& channel : channels) types.push_back(channel.type);
    return types;
}

std::vector<Part> read_parts(const InputFile& file, const ReadContext& context,
                             std::vector<std::vector<Attribute>> attributes) {
    int count = 0;
    if (exr_get_count(context.get(), &count) != EXR_ERR_SUCCESS ||
        static_cast<std::size_t>(count) != attributes.size())
        damaged(file, fmt::format("{} parts were expected, {} are there", count, attributes.size()));
    std::vector<Part> parts;
    parts.reserve(attributes.size());
    for (int i = 0; i < count; ++i)
        parts.push_back(PartReader(file, context.get(), i).read(std::move(attributes[index(i)])));
    return parts;
}

}  // namespace keyline::exr
