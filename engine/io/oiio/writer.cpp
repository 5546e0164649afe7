// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/oiio/writer.h"

#include "engine/base/error.h"
#include "engine/io/oiio/bands.h"
#include "engine/io/oiio/picture_tasks.h"
#include "engine/io/output_file.h"
#include "engine/io/output_format.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <utility>

namespace keyline::oiio {

namespace {

Sample sample_of(Depth depth) {
    return depth == Depth::kUint8    ? Sample::kUint8
           : depth == Depth::kUint16 ? Sample::kUint16
                                     : Sample::kFloat;
}

PictureSpec spec_of(const std::filesystem::path& file, const PictureLayout& layout, const SinkSpec& wanted) {
    const ChannelOrder& order = layout.order;
    PictureSpec spec;
    spec.file = file.string();
    spec.format = layout.format.name;
    spec.width = wanted.display_window.width();
    spec.height = wanted.display_window.height();
    for (const std::size_t c : order.channels)
        spec.channels.push_back(order.channels.size() == 1 ? "Y" : wanted.channels[c].name);
    if (order.alpha) spec.alpha = static_cast<int32_t>(*order.alpha);
    spec.is_straight = layout.format.straight_alpha;
    if (layout.format.tiled) spec.tile_size = kPictureChunkRows;
    spec.sample = sample_of(layout.depth);
    spec.compression = layout.compression;
    spec.metadata = wanted.metadata;
    return spec;
}

// A picture being written by a helper, under its name when it is whole.  Everything throws Failure (kOutput).
class PictureFile {
public:
    // Does not wait: while the helper program starts, what is to be written is computed.
    PictureFile(const std::filesystem::path& file, const PictureSpec& spec)
        : name_(file.string()),
          bounds_(bounds_of(0, uint64_t(spec.width) * uint64_t(spec.height) * spec.channels.size() * 4)),
          file_(file) {
        helper_->begin(request(PictureTask::kCreate), bounds_, spec.bytes(), file_.descriptor());
    }
    ~PictureFile() {
        if (!is_finished_) helper_->drop();
    }

    // Rows from the top on, in order.
    void write_rows(int begin, int end, std::span<const std::byte> rows) {
        ask(PictureTask::kWrite, begin, end, rows);
    }

    void finish() {
        ask(PictureTask::kFinish, 0, 0, {});
        is_finished_ = true;
        file_.publish();
    }

private:
    static HelperRequest request(PictureTask task) {
        HelperRequest out = {};
        out.task = static_cast<uint32_t>(task);
        return out;
    }

    void ask(PictureTask task, int begin, int end, std::span<const std::byte> rows) {
        try {
            HelperRequest asked = request(task);
            asked.first_row = begin;
            asked.rows = end - begin;
            const std::span<std::byte> shared = helper_->shared(rows.size());
            if (shared.size() >= rows.size()) {
                std::ranges::copy(rows, shared.begin());
                rows = {};
            }
            helper_->run(asked, bounds_, rows);
        } catch (const Failure& failure) {
            const Error& e = failure.error();
            if (e.kind != ErrorKind::kInput) throw;
            fail(ErrorKind::kOutput, fmt::format("{}: can't be written: {}", name_, e.what), e.hint,
                 e.passing);
        }
    }

    const std::string name_;
    const HelperBounds bounds_;
    OutputFile file_;
    Pool<Helper>::Lease helper_ = picture_helpers().take();
    bool is_finished_ = false;
};

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
          row_bytes_(sample_bytes(sample_of(layout_.depth)) * layout_.order.channels.size() *
                     static_cast<std::size_t>(region_.width())),
          file_(file, spec_of(file, layout_, wanted)) {
        for (ChannelInfo& channel : channels_) channel.type = SampleType::kFloat;
    }

    Rect region() const override { return region_; }
    int chunk_height() const override { return kPictureChunkRows; }
    const std::vector<ChannelInfo>& channels() const override { return channels_; }

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
        file_.write_rows(begin, end, chunk.bytes);
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
    const std::size_t row_bytes_;
    PictureFile file_;
    int committed_ = 0;
};

}  // namespace

std::unique_ptr<ImageSink> create_picture(const std::filesystem::path& file, const SinkSpec& spec) {
    return std::make_unique<PictureSink>(file, picture_layout(file, spec), spec);
}

}  // namespace keyline::oiio
