// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/image_io_writer.h"

#include "engine/error.h"
#include "engine/io/image_io_formats.h"
#include "engine/io/image_io_metadata.h"
#include "engine/io/image_io_output.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

namespace keyline::oiio {

namespace {

using OIIO::ImageSpec;
using OIIO::TypeDesc;

constexpr int kChunkHeight = 64;  // the tile of the one format that must have tiles

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what,
                         const std::string& hint) {
    fail(ErrorKind::kGraph, fmt::format("{}: {}", file.string(), what), hint);
}

// The channels in the order of the file, as indices into those given.
struct Order {
    std::vector<std::size_t> channels;
    std::optional<std::size_t> alpha;  // its place in `channels`
};

std::optional<std::size_t> index_of(const std::vector<ChannelInfo>& channels, std::string_view name) {
    const auto found = std::ranges::find(channels, name, &ChannelInfo::name);
    if (found == channels.end()) return std::nullopt;
    return static_cast<std::size_t>(found - channels.begin());
}

// The largest set of the format that the channels hold; "" for none.
std::string_view largest_set(const OutputFormat& format, const std::vector<ChannelInfo>& channels) {
    for (const std::string_view set : {"RGBA", "RGB", "YA", "Y"}) {
        const bool here = std::ranges::all_of(set, [&](const char& letter) {
            return index_of(channels, {&letter, 1}).has_value();
        });
        if (here && format.holds(set)) return set;
    }
    return {};
}

std::vector<std::string> names_beside(std::string_view set, const std::vector<ChannelInfo>& channels) {
    std::vector<std::string> names;
    for (const ChannelInfo& channel : channels)
        if (channel.name.size() != 1 || set.find(channel.name) == std::string_view::npos)
            names.push_back(channel.name);
    return names;
}

std::vector<std::string> letters(std::string_view set) {
    std::vector<std::string> names;
    for (const char letter : set) names.emplace_back(1, letter);
    return names;
}

[[noreturn]] void refuse_channels(const std::filesystem::path& file, const OutputFormat& format,
                                  std::string_view set, const std::vector<ChannelInfo>& channels) {
    std::vector<std::string> sets;
    for (const std::string_view held : format.channel_sets)
        sets.push_back(held == "Y" ? "one channel of any name" : spaced(letters(held)));
    refuse(file,
           fmt::format("{} can't hold {}; it holds {}", format.name, listed(names_beside(set, channels)),
                       listed(sets)),
           "leave channels out with 'channels'");
}

Order order_of(const std::filesystem::path& file, const OutputFormat& format,
               const std::vector<ChannelInfo>& channels) {
    if (channels.size() == 1 && format.holds("Y")) return {{0}, std::nullopt};
    const std::string_view set = largest_set(format, channels);
    const bool others = set.size() < channels.size();
    if (set.empty() || (others && !(format.more_channels && set.starts_with("RGB"))))
        refuse_channels(file, format, set, channels);
    Order order;
    for (const char& letter : set) order.channels.push_back(*index_of(channels, {&letter, 1}));
    if (set.ends_with('A')) order.alpha = set.size() - 1;
    for (std::size_t c = 0; c < channels.size(); ++c)
        if (std::ranges::find(order.channels, c) == order.channels.end()) order.channels.push_back(c);
    return order;
}

Depth depth_of(const std::filesystem::path& file, const OutputFormat& format, Depth wanted) {
    if (wanted == Depth::kAuto) return format.depths.front();
    if (std::ranges::find(format.depths, wanted) != format.depths.end()) return wanted;
    std::vector<std::string> names;
    for (const Depth depth : format.depths) names.emplace_back(depth_name(depth));
    refuse(file,
           fmt::format("{} has no depth {}; it has {}", format.name, in_quotes(depth_name(wanted)),
                       listed(names)),
           {});
}

bool is_quality(std::string_view text) {
    int quality = 0;
    const auto parsed = std::from_chars(text.data(), text.data() + text.size(), quality);
    return parsed.ec == std::errc{} && parsed.ptr == text.data() + text.size() && quality >= 1 &&
           quality <= 100;
}

// "zip" is what `write` says where nothing was asked for; formats without it take their own default then.
std::string compression_of(const std::filesystem::path& file, const OutputFormat& format,
                           const std::string& wanted) {
    const auto& known = format.compressions;
    if (std::ranges::find(known, wanted) != known.end()) return wanted;
    if (wanted == "zip") return known.empty() ? "" : std::string(known.front());
    const std::size_t colon = wanted.find(':');
    if (format.has_quality && wanted.substr(0, colon) == known.front() && colon != std::string::npos &&
        is_quality(std::string_view(wanted).substr(colon + 1)))
        return wanted;
    const std::string what = fmt::format("{} has no compression {}", format.name, in_quotes(wanted));
    if (known.empty()) refuse(file, what + "; there is no choice", "leave 'compression' out");
    refuse(file,
           fmt::format(
               "{}; it has {}{}", what, listed({known.begin(), known.end()}),
               format.has_quality ? fmt::format(" ('{}:90' with a quality of 1 to 100)", known.front()) : ""),
           did_you_mean(wanted, {known.begin(), known.end()}));
}

TypeDesc type_of(Depth depth) {
    return depth == Depth::kUint8    ? TypeDesc::UINT8
           : depth == Depth::kUint16 ? TypeDesc::UINT16
                                     : TypeDesc::FLOAT;
}

// PNG keeps text under names of 1 to 79 printable characters; libpng complains aloud about any other.
void drop_names_png_refuses(Metadata& metadata) {
    std::vector<std::string> refused;
    for (const Attribute& a : metadata.attributes()) {
        const bool printable = std::ranges::all_of(a.name, [](char c) { return c > ' ' && c < '\x7f'; });
        if (a.name.empty() || a.name.size() > 79 || !printable) refused.push_back(a.name);
    }
    for (const std::string& name : refused) metadata.erase(name);
}

ImageSpec spec_of(const OutputFormat& format, const SinkSpec& wanted, Depth depth, const Order& order,
                  const std::string& compression) {
    const Rect& window = wanted.display_window;
    ImageSpec spec(window.width(), window.height(), static_cast<int>(order.channels.size()), type_of(depth));
    Metadata metadata = wanted.metadata;
    if (format.name == "png") drop_names_png_refuses(metadata);
    set_metadata(spec, metadata);
    for (std::size_t i = 0; i < order.channels.size(); ++i)
        spec.channelnames[i] = order.channels.size() == 1 ? "Y" : wanted.channels[order.channels[i]].name;
    spec.alpha_channel = order.alpha ? static_cast<int>(*order.alpha) : -1;
    spec.z_channel = -1;
    if (format.tiled) spec.tile_width = spec.tile_height = kChunkHeight;
    // What encode() has divided must not be divided again, in integers.
    if (format.straight_alpha) spec.attribute("oiio:UnassociatedAlpha", 1);
    if (!compression.empty()) spec.attribute("compression", compression);
    // A render waits for this one thread.  Against zlib's 6, 16-bit frames with grain take 60 to 75 % of the
    // time and 1 % more room.
    spec.attribute("png:compressionLevel", 3);
    spec.attribute("tiff:zipquality", 3);
    return spec;
}

template <class T>
T stored(float value) {
    if constexpr (std::is_same_v<T, float>) {
        return value;
    } else {
        constexpr float most = std::numeric_limits<T>::max();
        if (!(value > 0.0F)) return 0;  // also NaN
        return value < 1.0F ? static_cast<T>(value * most + 0.5F) : std::numeric_limits<T>::max();
    }
}

// One row, `from` a pointer a channel, to interleaved samples.  Colour is divided by `alpha` where that is
// given and above 0.
template <class T>
void encode_row(std::span<const float* const> from, std::optional<std::size_t> alpha, int width,
                std::byte* to) {
    for (int x = 0; x < width; ++x) {
        const float a = alpha && from[*alpha][x] > 0.0F ? from[*alpha][x] : 1.0F;
        for (std::size_t c = 0; c < from.size(); ++c, to += sizeof(T)) {
            const T sample = stored<T>(alpha == c ? from[c][x] : from[c][x] / a);
            std::memcpy(to, &sample, sizeof(T));
        }
    }
}

class PictureSink : public ImageSink {
public:
    PictureSink(const std::filesystem::path& file, const OutputFormat& format, const SinkSpec& wanted)
        : PictureSink(file, format, wanted, order_of(file, format, wanted.channels)) {}

    Rect region() const override { return region_; }
    int chunk_height() const override { return kChunkHeight; }
    const std::vector<ChannelInfo>& channels() const override { return channels_; }
    std::size_t chunk_memory() const override { return row_bytes_ * kChunkHeight; }

    EncodedChunk encode(int index, std::span<const Plane> planes) const override {
        const int begin = region_.y0 + index * kChunkHeight, end = std::min(begin + kChunkHeight, region_.y1);
        EncodedChunk chunk{index, std::vector<std::byte>(row_bytes_ * static_cast<std::size_t>(end - begin))};
        std::vector<const float*> rows(order_.channels.size());
        std::byte* to = chunk.bytes.data();
        for (int y = begin; y < end; ++y, to += row_bytes_) {
            for (std::size_t i = 0; i < rows.size(); ++i)
                rows[i] = reinterpret_cast<const float*>(planes[order_.channels[i]].at(region_.x0, y));
            encode_rows(rows, to);
        }
        return chunk;
    }

    void commit(EncodedChunk chunk) override {
        const int begin = chunk.index * kChunkHeight, end = std::min(begin + kChunkHeight, region_.height());
        if (chunk.index != committed_ || begin >= end)
            fail(ErrorKind::kInternal,
                 fmt::format("{}: chunk {} committed after {}", name_, chunk.index, committed_));
        file_.write_rows(begin, end, chunk.bytes.data());
        ++committed_;
    }

    void finish() override {
        const int chunks = (region_.height() + kChunkHeight - 1) / kChunkHeight;
        if (committed_ != chunks)
            fail(ErrorKind::kInternal,
                 fmt::format("{}: {} of {} chunks committed", name_, committed_, chunks));
        file_.finish();
    }

private:
    PictureSink(const std::filesystem::path& file, const OutputFormat& format, const SinkSpec& wanted,
                Order order)
        : name_(file.string()),
          region_(wanted.display_window),
          order_(std::move(order)),
          channels_(wanted.channels),
          depth_(depth_of(file, format, wanted.depth)),
          straight_(format.straight_alpha),
          spec_(spec_of(format, wanted, depth_, order_, compression_of(file, format, wanted.compression))),
          row_bytes_(spec_.scanline_bytes()),
          file_(file, std::string(format.name), spec_) {
        for (ChannelInfo& channel : channels_) channel.type = SampleType::kFloat;
    }

    void encode_rows(std::span<const float* const> rows, std::byte* to) const {
        const auto divide_by = straight_ ? order_.alpha : std::nullopt;
        switch (depth_) {
            case Depth::kUint8: return encode_row<std::uint8_t>(rows, divide_by, region_.width(), to);
            case Depth::kUint16: return encode_row<std::uint16_t>(rows, divide_by, region_.width(), to);
            default: return encode_row<float>(rows, divide_by, region_.width(), to);
        }
    }

    const std::string name_;
    const Rect region_;
    const Order order_;
    std::vector<ChannelInfo> channels_;
    const Depth depth_;
    const bool straight_;
    const ImageSpec spec_;
    const std::size_t row_bytes_;
    PictureFile file_;
    int committed_ = 0;
};

}  // namespace

void check_picture(const std::filesystem::path& file, const SinkSpec& spec) {
    const OutputFormat& format = output_format(file);
    const Order order = order_of(file, format, spec.channels);
    spec_of(format, spec, depth_of(file, format, spec.depth), order,
            compression_of(file, format, spec.compression));
}

std::unique_ptr<ImageSink> create_picture(const std::filesystem::path& file, const SinkSpec& spec) {
    return std::make_unique<PictureSink>(file, output_format(file), spec);
}

}  // namespace keyline::oiio
