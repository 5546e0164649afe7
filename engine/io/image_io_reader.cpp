// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/image_io_reader.h"

#include "engine/error.h"
#include "engine/io/image_io_bands.h"
#include "engine/io/image_io_formats.h"
#include "engine/io/image_io_metadata.h"
#include "engine/io/output_format.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <optional>
#include <system_error>

namespace keyline::oiio {

namespace {

using OIIO::ImageSpec;
using OIIO::TypeDesc;

constexpr std::size_t kBandBytes = std::size_t{1} << 20;  // about; what a task decodes at once

// A picture larger than kSuspicious bytes whose file is kProportion times smaller is a trap, not a picture.
constexpr std::uint64_t kSuspicious = std::uint64_t{1} << 30, kProportion = 20000;

std::string named_format(const std::filesystem::path& file) {
    std::error_code error;
    const auto status = std::filesystem::status(file, error);
    if (!std::filesystem::exists(status))
        fail(ErrorKind::kInput,
             fmt::format("{}: {}", file.string(), std::generic_category().message(ENOENT)));
    if (!std::filesystem::is_regular_file(status))
        fail(ErrorKind::kInput, fmt::format("{}: not a regular file", file.string()));
    std::ifstream in(file, std::ios::binary);
    if (!in)
        fail(ErrorKind::kInput,
             fmt::format("{}: {}", file.string(), std::generic_category().message(EACCES)));
    std::array<std::byte, kFirstBytes> bytes = {};
    in.read(reinterpret_cast<char*>(bytes.data()), bytes.size());
    const auto n = static_cast<std::size_t>(in.gcount());
    if (n == 0) fail(ErrorKind::kInput, fmt::format("{}: the file is empty", file.string()));
    const std::string format = input_format(file, std::span(bytes).first(n));
    if (format.empty())
        fail(ErrorKind::kInput, fmt::format("{}: its content is of no known image format", file.string()),
             "known are " + spaced(input_extensions()));
    return format;
}

std::optional<int> number(const std::string& text) {
    int value = 0;
    const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
    if (parsed.ec != std::errc{} || parsed.ptr != text.data() + text.size()) return std::nullopt;
    return value;
}

// By name, else by number.  Throws Failure (kInput) that lists them.
int chosen_subimage(const std::filesystem::path& file, const std::string& format, const std::string& part) {
    if (part.empty()) return 0;
    const auto input = open_input(file, format, 0);
    std::vector<std::string> labels;
    while (input->seek_subimage(static_cast<int>(labels.size()), 0)) {
        const std::string name = input->spec().get_string_attribute("oiio:subimagename");
        if (name == part) return static_cast<int>(labels.size());
        labels.push_back(name.empty() ? std::to_string(labels.size()) : name);
    }
    error_of(*input);
    const auto index = number(part);
    if (index && *index >= 0 && static_cast<std::size_t>(*index) < labels.size()) return *index;
    fail(ErrorKind::kInput, fmt::format("{}: no part {}", file.string(), in_quotes(part)),
         fmt::format("its parts are {}", listed(labels)));
}

Rect window(int x, int y, int width, int height) {
    const auto fits = [](int at, int size) {
        return at >= -kMaxCoordinate && size > 0 && size <= kMaxCoordinate && at <= kMaxCoordinate - size;
    };
    return fits(x, width) && fits(y, height) ? Rect{x, y, x + width, y + height} : Rect{};
}

void require_sound(const std::filesystem::path& file, const ImageSpec& spec, const OpenOptions& options) {
    const auto refuse = [&](const std::string& why) {
        fail(ErrorKind::kInput, fmt::format("{}: {}", file.string(), why));
    };
    if (spec.deep) refuse("a deep image, which Keyline does not read");
    if (spec.depth > 1) refuse(fmt::format("a volume of {} slices, which Keyline does not read", spec.depth));
    if (spec.nchannels < 1) refuse("the image has no channels");
    if (window(spec.x, spec.y, spec.width, spec.height).empty())
        refuse(fmt::format("damaged header: a window of {} x {} pixels at ({}, {})", spec.width, spec.height,
                           spec.x, spec.y));
    const std::uint64_t row = std::uint64_t(spec.width) * unsigned(spec.nchannels) * sizeof(float);
    const std::uint64_t rows = std::uint64_t(std::max(1, spec.tile_height));
    if (row * rows > options.max_chunk_bytes)
        refuse(
            fmt::format("a chunk of {} x {} pixels of {} channels, which is more than the {} bytes there "
                        "are for it",
                        spec.width, rows, spec.nchannels, options.max_chunk_bytes));
    std::error_code error;
    const std::uint64_t size = std::filesystem::file_size(file, error);
    const std::uint64_t all = row * unsigned(spec.height);
    if (all > kSuspicious && all / kProportion > size)
        refuse(
            fmt::format("damaged: {} x {} pixels can't come from {} bytes", spec.width, spec.height, size));
}

// In which type the rows are decoded: the file's where we convert it ourselves, else float.
TypeDesc decoded_type(const ImageSpec& spec) {
    const bool ours = spec.format == TypeDesc::UINT8 || spec.format == TypeDesc::UINT16 ||
                      spec.format == TypeDesc::HALF || spec.format == TypeDesc::FLOAT;
    return ours && spec.channelformats.empty() ? TypeDesc(TypeDesc::BASETYPE(spec.format.basetype))
                                               : TypeDesc::FLOAT;
}

// Whole tiles; else whole strips where these are not too large.
int band_height(const ImageSpec& spec, std::size_t sample_bytes) {
    if (spec.tile_width > 0) return spec.tile_height;
    const std::size_t row = std::size_t(spec.width) * unsigned(spec.nchannels) * sample_bytes;
    const int rows = static_cast<int>(std::clamp<std::size_t>(kBandBytes / row, 1, std::size_t(spec.height)));
    const int strip = spec.get_int_attribute("tiff:RowsPerStrip");
    if (strip <= 0 || std::size_t(strip) * row > 4 * kBandBytes) return rows;
    return std::max(1, rows / strip) * strip;
}

// The reader of JPEG 2000 forgets to say so.
bool is_straight(const ImageSpec& spec, const std::string& format) {
    return spec.alpha_channel >= 0 && spec.alpha_channel < spec.nchannels && spec.nchannels > 1 &&
           (spec.get_int_attribute("oiio:UnassociatedAlpha") != 0 || format == "jpeg2000");
}

std::vector<ChannelInfo> channels_of(const ImageSpec& spec, SampleType type) {
    std::vector<ChannelInfo> channels;
    for (int c = 0; c < spec.nchannels; ++c) {
        std::string name = spec.channel_name(c);
        if (name.empty() || std::ranges::find(channels, name, &ChannelInfo::name) != channels.end())
            name = fmt::format("channel{}", c);
        channels.push_back({std::move(name), type});
    }
    return channels;
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

class Picture : public ImageSource {
public:
    Picture(const std::filesystem::path& file, const OpenOptions& options) {
        const std::string format = named_format(file);
        if (!options.view.empty())
            fail(ErrorKind::kInput, fmt::format("{}: no view {}", file.string(), in_quotes(options.view)),
                 "it has no views");
        const int subimage = chosen_subimage(file, format, options.part);
        const ImageSpec spec = open_input(file, format, subimage)->spec();
        require_sound(file, spec, options);
        straight_ = is_straight(spec, format);
        alpha_ = spec.alpha_channel;
        decoded_ = decoded_type(spec);
        if (decoded_ == TypeDesc::HALF && straight_) decoded_ = TypeDesc::FLOAT;
        bands_ = std::make_unique<BandReader>(file, format, subimage, spec, decoded_,
                                              band_height(spec, decoded_.size()));
        make_header(spec, format);
    }

    const ImageHeader& header() const override { return header_; }

    void read_chunk(std::size_t, int, int row, std::span<const Plane> planes) const override {
        const std::shared_ptr<const Band> band = bands_->band(row);
        const Rect chunk = header_.groups[0].chunk(0, row);
        for (std::size_t c = 0; c < planes.size(); ++c)
            if (planes[c].data != nullptr) store(*band, chunk, c, planes[c]);
    }

    std::size_t chunk_memory(std::size_t) const override { return bands_->band_bytes(); }

private:
    void make_header(const ImageSpec& spec, const std::string& format) {
        header_.data_window = window(spec.x, spec.y, spec.width, spec.height);
        header_.display_window = window(spec.full_x, spec.full_y, spec.full_width, spec.full_height);
        if (header_.display_window.empty()) header_.display_window = header_.data_window;
        header_.metadata = metadata_of(spec);
        header_.format = format;
        const SampleType type = decoded_ == TypeDesc::HALF ? SampleType::kHalf : SampleType::kFloat;
        header_.groups = {{channels_of(spec, type), header_.data_window, spec.width, bands_->band_height()}};
    }

    void store(const Band& band, const Rect& chunk, std::size_t channel, const Plane& plane) const {
        const auto sample = static_cast<std::ptrdiff_t>(decoded_.size());
        const auto channels = static_cast<std::ptrdiff_t>(header_.groups[0].channels.size());
        RowLayout layout{channels * sample, static_cast<std::ptrdiff_t>(channel) * sample, std::nullopt};
        if (straight_ && static_cast<int>(channel) != alpha_) layout.alpha = alpha_ * sample;
        const Rect part = intersect(chunk, plane.rect);
        for (int y = part.y0; y < part.y1; ++y) {
            const std::byte* from =
                band.data() +
                (std::ptrdiff_t{y - chunk.y0} * chunk.width() + part.x0 - chunk.x0) * layout.step;
            store_row(from, layout, part.width(), plane.at(part.x0, y));
        }
    }

    void store_row(const std::byte* from, const RowLayout& layout, int n, std::byte* to) const {
        switch (decoded_.basetype) {
            case TypeDesc::UINT8: return store_floats<std::uint8_t>(from, layout, n, to);
            case TypeDesc::UINT16: return store_floats<std::uint16_t>(from, layout, n, to);
            case TypeDesc::HALF: return copy_halves(from, layout, n, to);
            default: return store_floats<float>(from, layout, n, to);
        }
    }

    ImageHeader header_;
    TypeDesc decoded_;
    bool straight_ = false;
    int alpha_ = -1;
    std::unique_ptr<BandReader> bands_;
};

}  // namespace

std::unique_ptr<ImageSource> open_picture(const std::filesystem::path& file, const OpenOptions& options) {
    return std::make_unique<Picture>(file, options);
}

}  // namespace keyline::oiio
