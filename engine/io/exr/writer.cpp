// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/exr/writer.h"

#include "engine/base/bad_value.h"
#include "engine/io/exr/pack.h"
#include "engine/io/output_file.h"
#include "engine/io/pool.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <mutex>
#include <numeric>

namespace keyline::exr {

namespace {

// Chunks of one row are taken in this many at once, so that encoding them is worth a task.
constexpr int kRowsOfSmallChunks = 16;

Compression compression_named(const std::string& name) {
    const auto* const found =
        std::ranges::find_if(kCompressions, [&](const CompressionInfo& c) { return name == c.name; });
    if (found != kCompressions.end()) return static_cast<Compression>(found - kCompressions.begin());
    std::vector<std::string> names;
    for (const CompressionInfo& c : kCompressions) names.emplace_back(c.name);
    throw BadValue(name,
                   fmt::format("an OpenEXR file can't have compression {}; it can have {}", in_quotes(name),
                               listed(names)),
                   did_you_mean(name, names));
}

SampleType stored_type(const ChannelInfo& channel, Depth depth) {
    if (channel.exact && (depth == Depth::kHalf || depth == Depth::kFloat)) return channel.type;
    switch (depth) {
        case Depth::kAuto: return channel.type;
        case Depth::kHalf: return SampleType::kHalf;
        case Depth::kFloat: return SampleType::kFloat;
        default:
            const std::string name = depth == Depth::kUint8 ? "uint8" : "uint16";
            throw BadValue(
                name,
                fmt::format("an OpenEXR file can't have depth '{}'; it can have 'half' and 'float'", name),
                {});
    }
}

Rect stored_window(const SinkSpec& spec) {
    const Rect& display = spec.display_window;
    return spec.data_window.empty() ? Rect{display.x0, display.y0, display.x0 + 1, display.y0 + 1}
                                    : spec.data_window;
}

// The places of `channels` in the order of their names.
std::vector<std::size_t> sorted_order(const std::vector<ChannelInfo>& channels) {
    std::vector<std::size_t> order(channels.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t i) -> const std::string& { return channels[i].name; });
    return order;
}

class Sink final : public ImageSink {
public:
    Sink(const std::filesystem::path& file, const SinkSpec& spec)
        : layout_(layout_of(spec)),
          is_empty_(spec.data_window.empty()),
          order_(sorted_order(spec.channels)),
          channels_(spec.channels),
          pack_context_(Packer::uses_core(layout_) ? std::make_unique<PackContext>(layout_) : nullptr),
          packers_([this] { return std::make_unique<Packer>(layout_, pack_context_.get()); }),
          header_(layout_.header()),
          file_(file) {
        for (ChannelInfo& channel : channels_) channel.type = stored_type(channel, spec.depth);
        file_.append(header_);
        offsets_.reserve(static_cast<std::size_t>(layout_.chunks()));
        file_.append(std::vector<std::byte>(static_cast<std::size_t>(layout_.chunks()) * sizeof(uint64_t)));
    }

    Rect region() const override { return layout_.data_window; }
    int chunk_height() const override { return rows_at_once(layout_); }
    const std::vector<ChannelInfo>& channels() const override { return channels_; }

    EncodedChunk encode(int index, std::span<const Plane> planes) const override {
        const Rect whole = chunk(index);
        if (!is_empty_) check_planes(whole, planes);
        std::vector<Plane> sorted;
        std::vector<std::byte> zero(sizeof(float));
        for (const std::size_t i : order_)
            sorted.push_back(is_empty_ ? Plane{zero.data(), 0, channels_[i].type, whole} : planes[i]);
        EncodedChunk encoded{index, spare_buffer()};
        encoded.bytes.reserve(most_bytes(whole));  // one that grows would be held twice
        const auto packer = packers_.take();
        for (int y = whole.y0; y < whole.y1; y += layout_.rows_per_chunk())
            packer->pack(intersect(whole, {whole.x0, y, whole.x1, y + layout_.rows_per_chunk()}), sorted,
                         encoded.bytes);
        return encoded;
    }

    void commit(EncodedChunk chunk) override {
        if (chunk.index != next_)
            fail(ErrorKind::kInternal, fmt::format("chunk {} committed in place of {}", chunk.index, next_));
        ++next_;
        const std::span<const std::byte> bytes(chunk.bytes);
        for (std::size_t at = 0; at < bytes.size(); at += std::size_t{8} + get<uint32_t>(bytes, at + 4))
            offsets_.push_back(file_.size() + at);
        file_.append(bytes);
        chunk.bytes.clear();
        const std::scoped_lock lock(spare_mutex_);
        spare_.push_back(std::move(chunk.bytes));
    }

    void finish() override {
        if (offsets_.size() != static_cast<std::size_t>(layout_.chunks()))
            fail(ErrorKind::kInternal,
                 fmt::format("{} chunks of {} were written", offsets_.size(), layout_.chunks()));
        file_.overwrite(header_.size(), std::as_bytes(std::span(offsets_)));
        file_.publish();
    }

private:
    Rect chunk(int index) const {
        const Rect& window = layout_.data_window;
        const int y = window.y0 + index * chunk_height();
        return intersect(window, {window.x0, y, window.x1, y + chunk_height()});
    }

    // What a chunk before was in: to get its pages anew takes longer than to copy what is not compressed.
    std::vector<std::byte> spare_buffer() const {
        const std::scoped_lock lock(spare_mutex_);
        if (spare_.empty()) return {};
        std::vector<std::byte> buffer = std::move(spare_.back());
        spare_.pop_back();
        return buffer;
    }

    // What can't be compressed is as large as it was, and has its place and size before it.
    std::size_t most_bytes(const Rect& rect) const {
        std::size_t pixel = 0;
        for (const StoredChannel& c : layout_.channels) pixel += sample_size(c.type);
        const std::size_t chunks = static_cast<std::size_t>(rect.height() / layout_.rows_per_chunk()) + 1;
        return pixel * static_cast<std::size_t>(rect.area()) + chunks * 2 * sizeof(int32_t);
    }

    // What is wrong here would be read past its end below.
    void check_planes(const Rect& rect, std::span<const Plane> planes) const {
        const auto fits = [&](const Plane& p, const ChannelInfo& c) {
            return p.data != nullptr && p.type == c.type && p.rect.contains(rect);
        };
        if (rect.empty() || !std::ranges::equal(planes, channels_, fits))
            fail(ErrorKind::kInternal,
                 fmt::format("rows {} to {} were not given as the file stores them", rect.y0, rect.y1 - 1));
    }

    Layout layout_;
    bool is_empty_;
    std::vector<std::size_t> order_;  // the file's order, as places in the spec's
    std::vector<ChannelInfo> channels_;
    std::unique_ptr<PackContext> pack_context_;
    mutable Pool<Packer> packers_;
    std::vector<std::byte> header_;
    OutputFile file_;
    int next_ = 0;
    std::vector<uint64_t> offsets_;  // of the chunks committed
    mutable std::mutex spare_mutex_;
    mutable std::vector<std::vector<std::byte>> spare_;
};

// What rounds floats would make other ids of them.
void refuse_lossy(const SinkSpec& spec, Compression compression) {
    const bool dwa = compression == Compression::kDwaa || compression == Compression::kDwab;
    const auto is_harmed = [&](const ChannelInfo& c) {
        return c.exact && c.type != SampleType::kHalf &&
               (dwa || (compression == Compression::kPxr24 && c.type == SampleType::kFloat));
    };
    const auto harmed = std::ranges::find_if(spec.channels, is_harmed);
    if (harmed != spec.channels.end())
        fail(ErrorKind::kGraph,
             fmt::format("the compression {} would round {}; ids and their coverage must stay whole",
                         in_quotes(spec.compression), in_quotes(harmed->name)),
             "use zip, zips, piz, rle or none, or leave the ids out with 'channels'");
}

}  // namespace

int rows_at_once(const Layout& layout) { return std::max(layout.rows_per_chunk(), kRowsOfSmallChunks); }

Layout layout_of(const SinkSpec& spec) {
    Layout layout;
    layout.display_window = spec.display_window;
    layout.data_window = stored_window(spec);
    layout.compression = compression_named(spec.compression);
    layout.metadata = spec.metadata;
    refuse_lossy(spec, layout.compression);
    if (spec.channels.empty()) fail(ErrorKind::kGraph, "an OpenEXR file must have channels; there are none");
    for (const std::size_t i : sorted_order(spec.channels)) {
        const ChannelInfo& channel = spec.channels[i];
        if (!layout.channels.empty() && layout.channels.back().name == channel.name)
            fail(ErrorKind::kGraph, fmt::format("two channels are named {}", in_quotes(channel.name)));
        if (!can_be_stored(channel.name))
            fail(ErrorKind::kGraph,
                 fmt::format(
                     "{} can't be a channel's name in an OpenEXR file; 1 to {} bytes can, none of them 0",
                     in_quotes(channel.name), kLongestName));
        layout.channels.push_back({channel.name, stored_type(channel, spec.depth)});
    }
    const double rows = std::min(layout.rows_per_chunk(), layout.data_window.height());
    double chunk = 0;
    for (const StoredChannel& c : layout.channels)
        chunk += rows * layout.data_window.width() * static_cast<double>(sample_size(c.type));
    if (chunk > std::numeric_limits<int32_t>::max())
        fail(ErrorKind::kGraph,
             fmt::format("{:.0f} rows of {} pixels are {:.0f} bytes; an OpenEXR file can have {} at once",
                         rows, layout.data_window.width(), chunk, std::numeric_limits<int32_t>::max()),
             "choose a compression with smaller chunks, or fewer channels");
    return layout;
}

SinkMemory memory_of(const SinkSpec& spec) {
    const Layout layout = layout_of(spec);
    // Encoded chunks wait for those before them.
    const int rows = std::min(rows_at_once(layout), layout.data_window.height());
    const int chunks = (rows + layout.rows_per_chunk() - 1) / layout.rows_per_chunk();
    return {Packer::memory(layout) + static_cast<std::size_t>(chunks) * Packer::most_packed(layout),
            2 * sizeof(uint64_t) * static_cast<std::size_t>(layout.chunks())};
}

std::unique_ptr<ImageSink> create_exr(const std::filesystem::path& file, const SinkSpec& spec) {
    return std::make_unique<Sink>(file, spec);
}

}  // namespace keyline::exr
