// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/image_io_writer.h"

#include "engine/error.h"
#include "engine/io/image_io_metadata.h"
#include "engine/io/image_io_output.h"
#include "engine/io/output_format.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <utility>

namespace keyline::oiio {

namespace {

using OIIO::ImageSpec;
using OIIO::TypeDesc;

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

ImageSpec spec_of(const PictureLayout& layout, const SinkSpec& wanted) {
    const OutputFormat& format = layout.format;
    const ChannelOrder& order = layout.order;
    const Rect& window = wanted.display_window;
    ImageSpec spec(window.width(), window.height(), static_cast<int>(order.channels.size()),
                   type_of(layout.depth));
    Metadata metadata = wanted.metadata;
    if (format.name == "png") drop_names_png_refuses(metadata);
    set_metadata(spec, metadata);
    for (std::size_t i = 0; i < order.channels.size(); ++i)
        spec.channelnames[i] = order.channels.size() == 1 ? "Y" : wanted.channels[order.channels[i]].name;
    spec.alpha_channel = order.alpha ? static_cast<int>(*order.alpha) : -1;
    spec.z_channel = -1;
    if (format.tiled) spec.tile_width = spec.tile_height = kPictureChunkRows;
    // What encode() has divided must not be divided again, in integers.
    if (format.straight_alpha) spec.attribute("oiio:UnassociatedAlpha", 1);
    if (!layout.compression.empty()) spec.attribute("compression", layout.compression);
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
    PictureSink(const std::filesystem::path& file, PictureLayout layout, const SinkSpec& wanted)
        : name_(file.string()),
          region_(wanted.display_window),
          layout_(std::move(layout)),
          channels_(wanted.channels),
          spec_(spec_of(layout_, wanted)),
          row_bytes_(spec_.scanline_bytes()),
          file_(file, std::string(layout_.format.name), spec_) {
        for (ChannelInfo& channel : channels_) channel.type = SampleType::kFloat;
    }

    Rect region() const override { return region_; }
    int chunk_height() const override { return kPictureChunkRows; }
    const std::vector<ChannelInfo>& channels() const override { return channels_; }
    std::size_t chunk_memory() const override { return row_bytes_ * kPictureChunkRows; }

    EncodedChunk encode(int index, std::span<const Plane> planes) const override {
        const int begin = region_.y0 + index * kPictureChunkRows,
                  end = std::min(begin + kPictureChunkRows, region_.y1);
        EncodedChunk chunk{index, std::vector<std::byte>(row_bytes_ * static_cast<std::size_t>(end - begin))};
        std::vector<const float*> rows(layout_.order.channels.size());
        std::byte* to = chunk.bytes.data();
        for (int y = begin; y < end; ++y, to += row_bytes_) {
            for (std::size_t i = 0; i < rows.size(); ++i)
                rows[i] = reinterpret_cast<const float*>(planes[layout_.order.channels[i]].at(region_.x0, y));
            encode_rows(rows, to);
        }
        return chunk;
    }

    void commit(EncodedChunk chunk) override {
        const int begin = chunk.index * kPictureChunkRows,
                  end = std::min(begin + kPictureChunkRows, region_.height());
        if (chunk.index != committed_ || begin >= end)
            fail(ErrorKind::kInternal,
                 fmt::format("{}: chunk {} committed after {}", name_, chunk.index, committed_));
        file_.write_rows(begin, end, chunk.bytes.data());
        ++committed_;
    }

    void finish() override {
        const int chunks = (region_.height() + kPictureChunkRows - 1) / kPictureChunkRows;
        if (committed_ != chunks)
            fail(ErrorKind::kInternal,
                 fmt::format("{}: {} of {} chunks committed", name_, committed_, chunks));
        file_.finish();
    }

private:
    void encode_rows(std::span<const float* const> rows, std::byte* to) const {
        const auto divide_by = layout_.format.straight_alpha ? layout_.order.alpha : std::nullopt;
        switch (layout_.depth) {
            case Depth::kUint8: return encode_row<std::uint8_t>(rows, divide_by, region_.width(), to);
            case Depth::kUint16: return encode_row<std::uint16_t>(rows, divide_by, region_.width(), to);
            default: return encode_row<float>(rows, divide_by, region_.width(), to);
        }
    }

    const std::string name_;
    const Rect region_;
    const PictureLayout layout_;
    std::vector<ChannelInfo> channels_;
    const ImageSpec spec_;
    const std::size_t row_bytes_;
    PictureFile file_;
    int committed_ = 0;
};

}  // namespace

std::unique_ptr<ImageSink> create_picture(const std::filesystem::path& file, const SinkSpec& spec) {
    return std::make_unique<PictureSink>(file, picture_layout(file, spec), spec);
}

}  // namespace keyline::oiio
