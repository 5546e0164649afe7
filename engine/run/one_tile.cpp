// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/run/one_tile.h"

#include "engine/plan/planner.h"
#include "engine/run/execute.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <string_view>

namespace keyline {

namespace {

// Keeps the samples of a region, whole.
class Kept final : public ImageSink {
public:
    Kept(const SinkSpec& spec, std::vector<std::vector<float>>& samples)
        : region_(spec.data_window), channels_(spec.channels), samples_(samples) {
        samples_.assign(channels_.size(), std::vector<float>(static_cast<std::size_t>(region_.area())));
    }
    Rect region() const override { return region_; }
    int chunk_height() const override { return std::max(1, region_.height()); }
    const std::vector<ChannelInfo>& channels() const override { return channels_; }
    EncodedChunk encode(int index, std::span<const Plane> planes) const override {
        for (std::size_t c = 0; c < planes.size(); ++c) {
            auto out = samples_[c].begin();
            for (int y = region_.y0; y < region_.y1; ++y)
                out = std::copy_n(reinterpret_cast<const float*>(planes[c].at(region_.x0, y)),
                                  region_.width(), out);
        }
        return {index, {}};
    }
    void commit(EncodedChunk) override {}
    void finish() override {}

private:
    const Rect region_;
    const std::vector<ChannelInfo> channels_;
    std::vector<std::vector<float>>& samples_;
};

Sink sink_of(const Stream& stream, const Rect& region, std::vector<std::vector<float>>& samples) {
    Sink sink;
    sink.title = "the tile";
    SinkRequest& request = sink.request;
    request.stream = stream;
    request.stream.window = intersect(stream.window, region);
    request.spec.display_window = request.spec.data_window = request.stream.window;
    for (const StreamChannel& c : stream.channels)
        request.spec.channels.push_back({c.name, SampleType::kFloat});
    request.create = [&samples](const SinkSpec& spec) { return std::make_unique<Kept>(spec, samples); };
    return sink;
}

TileChannel summary(const std::string& name, const std::vector<float>& samples) {
    TileChannel out;
    out.name = name;
    out.samples = Digester("samples")
                      .add(std::string_view(reinterpret_cast<const char*>(samples.data()),
                                            samples.size() * sizeof(float)))
                      .digest();
    out.least = std::numeric_limits<float>::infinity();
    out.most = -out.least;
    for (const float s : samples) {
        if (!std::isfinite(s)) {
            ++out.not_finite;
            continue;
        }
        out.least = std::min(out.least, s);
        out.most = std::max(out.most, s);
    }
    return out;
}

}  // namespace

std::string command_for(const std::string& command, const OneTile& tile) {
    return fmt::format("{} --only-tile {}@{},{},{},{} --frames={}", command, tile.node, tile.region.x0,
                       tile.region.y0, tile.region.width(), tile.region.height(), tile.frame);
}

std::vector<TileChannel> render_one_tile(const Graph& graph, const OneTile& tile,
                                         const RenderOptions& options, Diagnostics& diagnostics) {
    auto resolved = check(graph, tile.frame, options, diagnostics);
    if (!resolved) return {};
    const auto node = std::ranges::find(resolved->streams, graph.index_of(tile.node), &NodeStream::node);
    if (node == resolved->streams.end() || node->stream.is_data()) {
        diagnostics.error({ErrorKind::kGraph,
                           {},
                           {},
                           fmt::format("there is no node {} that makes an image", in_quotes(tile.node)),
                           {}});
        return {};
    }
    std::vector<std::vector<float>> samples;
    resolved->sinks = {sink_of(node->stream, tile.region, samples)};
    const std::vector<std::string> names = node->stream.names();
    constexpr int kWhole = 1 << 20;  // no region is cut
    Executor(1).run(std::make_unique<FrameRun>(make_plan(std::move(*resolved), {1, kWhole, 0})), false);
    std::vector<TileChannel> out;
    for (std::size_t i = 0; i < samples.size(); ++i) out.push_back(summary(names[i], samples[i]));
    return out;
}

}  // namespace keyline
