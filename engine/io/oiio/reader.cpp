// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/oiio/reader.h"

#include "engine/base/error.h"
#include "engine/io/oiio/bands.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <string_view>
#include <system_error>

namespace keyline::oiio {

namespace {

constexpr std::size_t kBandBytes = std::size_t{1} << 20;  // about; what a task decodes at once

// A picture larger than kSuspicious bytes whose file is kProportion times smaller is a trap, not a picture.
constexpr std::uint64_t kSuspicious = std::uint64_t{1} << 30, kProportion = 20000;

Rect window(int x, int y, int width, int height) {
    const auto fits = [](int at, int size) {
        return at >= -kMaxCoordinate && size > 0 && size <= kMaxCoordinate && at <= kMaxCoordinate - size;
    };
    return fits(x, width) && fits(y, height) ? Rect{x, y, x + width, y + height} : Rect{};
}

// The helper may have been taken in by the file: what it says is looked at here.
void require_sound(const std::filesystem::path& file, const PictureHeader& h, const OpenOptions& options) {
    const auto refuse = [&](const std::string& why) {
        fail(ErrorKind::kInput, fmt::format("{}: {}", file.string(), why));
    };
    if (h.is_deep) refuse("a deep image, which Keyline does not read");
    if (h.depth > 1) refuse(fmt::format("a volume of {} slices, which Keyline does not read", h.depth));
    if (h.channels.empty() || h.types.size() != h.channels.size()) refuse("the image has no channels");
    if (window(h.x, h.y, h.width, h.height).empty())
        refuse(fmt::format("damaged header: a window of {} x {} pixels at ({}, {})", h.width, h.height, h.x,
                           h.y));
    const std::uint64_t row = std::uint64_t(h.width) * h.channels.size() * sizeof(float);
    const std::uint64_t rows = std::uint64_t(std::max(1, h.tile_height));
    if (row * rows > options.max_chunk_bytes)
        refuse(
            fmt::format("a chunk of {} x {} pixels of {} channels, which is more than the {} bytes there "
                        "are for it",
                        h.width, rows, h.channels.size(), options.max_chunk_bytes));
    std::error_code error;
    const std::uint64_t size = std::filesystem::file_size(file, error);
    const std::uint64_t all = row * unsigned(h.height);
    if (all > kSuspicious && all / kProportion > size)
        refuse(fmt::format("damaged: {} x {} pixels can't come from {} bytes", h.width, h.height, size));
}

// Whole tiles; else whole strips where these are not too large.
int band_height(const PictureHeader& h, Sample sample) {
    if (h.tile_height > 0) return h.tile_height;
    const std::size_t row = std::size_t(h.width) * h.channels.size() * sample_bytes(sample);
    const int rows = static_cast<int>(std::clamp<std::size_t>(kBandBytes / row, 1, std::size_t(h.height)));
    if (h.strip_rows <= 0 || std::size_t(h.strip_rows) * row > 4 * kBandBytes) return rows;
    return std::max(1, rows / h.strip_rows) * h.strip_rows;
}

// How many frames of its samples a library holds while it reads; measured at HD and at 4K, with RGB of 8
// bits.
double frames_held(std::string_view format) {
    struct Held {
        std::string_view format;
        double frames;
    };
    static constexpr std::array<Held, 5> all{
        {{"gif", 1.8}, {"jpeg2000", 4.6}, {"pnm", 1}, {"targa", 1}, {"webp", 1.1}}};
    const auto* const found = std::ranges::find(all, format, &Held::format);
    return found == all.end() ? 0 : found->frames;
}

std::vector<ChannelInfo> channels_of(const PictureHeader& header, SampleType type) {
    std::vector<ChannelInfo> channels;
    for (std::string name : header.channels) {
        if (name.empty() || std::ranges::find(channels, name, &ChannelInfo::name) != channels.end())
            name = fmt::format("channel{}", channels.size());
        channels.push_back({std::move(name), type});
    }
    return channels;
}

PictureHeader header_of(const PictureRequest& request) {
    return open_in(*picture_helpers().take(), request, 0);
}

// One sample as float: the nearest one to value / maximum.  Halves never pass here: they are copied, but for
// those that are multiplied, which are decoded as floats.
template <class T>
float as_float(const std::byte* from) {
    T value;
    std::memcpy(&value, from, sizeof(T));
    if constexpr (std::is_integral_v<T>)
        return static_cast<float>(value) / static_cast<float>(std::numeric_limits<T>::max());
    else
        return value;
}

struct RowLayout {
    std::ptrdiff_t step;                  // bytes from pixel to pixel
    std::ptrdiff_t channel;               // byte of the wanted sample in a pixel
    std::optional<std::ptrdiff_t> alpha;  // byte of the one to multiply by
};

template <class T>
void store_floats(const std::byte* from, const RowLayout& layout, int n, std::byte* to) {
    for (int i = 0; i < n; ++i, from += layout.step, to += sizeof(float)) {
        float value = as_float<T>(from + layout.channel);
        if (layout.alpha) value *= as_float<T>(from + *layout.alpha);
        std::memcpy(to, &value, sizeof(float));
    }
}

void copy_halves(const std::byte* from, const RowLayout& layout, int n, std::byte* to) {
    for (int i = 0; i < n; ++i, from += layout.step, to += 2) std::memcpy(to, from + layout.channel, 2);
}

class Picture final : public PictureSource {
public:
    Picture(const std::filesystem::path& file, const OpenOptions& options) {
        PictureRequest request{file.string(), options.part, false};
        const PictureHeader header = header_of(request);
        if (!options.view.empty())
            fail(ErrorKind::kInput, fmt::format("{}: no view {}", file.string(), in_quotes(options.view)),
                 "it has no views");
        require_sound(file, header, options);
        const auto channels = static_cast<int>(header.channels.size());
        if (header.alpha >= 0 && header.alpha < channels) alpha_ = header.alpha;
        sample_ = header.sample;
        // Multiplied in float.
        if (sample_ == Sample::kHalf && alpha_) sample_ = Sample::kFloat;
        request.to_be_read = true;
        bands_ = std::make_unique<BandReader>(request, header, sample_, band_height(header, sample_));
        make_header(header);
    }

    void read_chunk(std::size_t, int, int row, std::span<const Plane> planes) const override {
        const std::shared_ptr<const Band> band = bands_->band(row);
        const Rect chunk = header_.groups[0].chunk(0, row);
        for (std::size_t c = 0; c < planes.size(); ++c)
            if (planes[c].data != nullptr) store(*band, chunk, c, planes[c]);
    }

    std::size_t chunk_memory(std::size_t) const override { return bands_->band_bytes(); }
    std::size_t held_memory() const override {
        const double samples = static_cast<double>(header_.data_window.area()) *
                               static_cast<double>(header_.groups[0].channels.size());
        const double frame = samples * static_cast<double>(sample_bytes(sample_));
        return bands_->kept_bytes() + static_cast<std::size_t>(frames_held(header_.format) * frame);
    }

private:
    void make_header(const PictureHeader& h) {
        header_.data_window = window(h.x, h.y, h.width, h.height);
        header_.display_window = window(h.full_x, h.full_y, h.full_width, h.full_height);
        if (header_.display_window.empty()) header_.display_window = header_.data_window;
        header_.metadata = h.metadata;
        header_.format = h.format;
        stored_types_ = h.types;
        const SampleType type = sample_ == Sample::kHalf ? SampleType::kHalf : SampleType::kFloat;
        header_.groups = {{channels_of(h, type), header_.data_window, h.width, bands_->band_height()}};
    }

    void store(const Band& band, const Rect& chunk, std::size_t channel, const Plane& plane) const {
        const auto sample = static_cast<std::ptrdiff_t>(sample_bytes(sample_));
        const auto channels = static_cast<std::ptrdiff_t>(header_.groups[0].channels.size());
        RowLayout layout{channels * sample, static_cast<std::ptrdiff_t>(channel) * sample, std::nullopt};
        if (alpha_ && static_cast<int>(channel) != *alpha_) layout.alpha = *alpha_ * sample;
        const Rect part = intersect(chunk, plane.rect);
        for (int y = part.y0; y < part.y1; ++y) {
            const std::byte* from =
                band.data() +
                (std::ptrdiff_t{y - chunk.y0} * chunk.width() + part.x0 - chunk.x0) * layout.step;
            store_row(from, layout, part.width(), plane.at(part.x0, y));
        }
    }

    void store_row(const std::byte* from, const RowLayout& layout, int n, std::byte* to) const {
        switch (sample_) {
            case Sample::kUint8: return store_floats<std::uint8_t>(from, layout, n, to);
            case Sample::kUint16: return store_floats<std::uint16_t>(from, layout, n, to);
            case Sample::kHalf: return copy_halves(from, layout, n, to);
            case Sample::kFloat: return store_floats<float>(from, layout, n, to);
        }
    }

    Sample sample_ = Sample::kFloat;
    std::optional<int> alpha_;  // the channel that the others are multiplied by
    std::unique_ptr<BandReader> bands_;
};

}  // namespace

std::unique_ptr<PictureSource> open_picture(const std::filesystem::path& file, const OpenOptions& options) {
    return std::make_unique<Picture>(file, options);
}

}  // namespace keyline::oiio
