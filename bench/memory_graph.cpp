// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/memory_graph.h"

#include "engine/graph/graph.h"
#include "engine/node/node_adaptor.h"
#include "engine/node/registry.h"
#include "engine/plan/planner.h"

#include <fmt/format.h>
#include <map>
#include <mutex>
#include <stdexcept>

namespace keyline::bench {

namespace {

// What a graph's text can't hold: the pictures of graphs, by a number that it can.
struct Shelf {
    std::vector<const Picture*> sources;
    std::vector<Picture*> results;
};

Shelf& shelf() {
    static Shelf the_shelf;
    return the_shelf;
}

Plane plane_of(Picture& picture, std::size_t channel) {
    return {reinterpret_cast<std::byte*>(picture.planes[channel].data()),
            picture.width * static_cast<std::ptrdiff_t>(sizeof(float)),
            SampleType::kFloat,
            {0, 0, picture.width, picture.height}};
}

class MemorySource final : public ImageSource {
public:
    explicit MemorySource(const Picture& picture) : picture_(picture) {
        const Rect window{0, 0, picture.width, picture.height};
        header_.display_window = header_.data_window = window;
        ChannelGroup group{{}, window, picture.width, picture.height};
        for (const std::string& name : picture.channels) group.channels.push_back({name, SampleType::kFloat});
        header_.groups.push_back(std::move(group));
    }

    const ImageHeader& header() const override { return header_; }
    std::size_t chunk_memory(std::size_t) const override { return 0; }
    void read_chunk(std::size_t, int, int, std::span<const Plane>) const override {}

    // Read only: no operation writes to what it reads.
    Plane resident(std::size_t, std::size_t channel) const override {
        return plane_of(const_cast<Picture&>(picture_), channel);
    }

private:
    const Picture& picture_;
    ImageHeader header_;
};

class MemorySink final : public ImageSink {
public:
    MemorySink(const SinkSpec& spec, Picture& picture) : picture_(picture), channels_(spec.channels) {
        std::vector<std::string> names;
        for (ChannelInfo& c : channels_) {
            names.push_back(c.name);
            c.type = SampleType::kFloat;
        }
        // Pages of the run before are used again: what is timed is not the kernel that clears new ones.
        const int width = spec.data_window.width(), height = spec.data_window.height();
        if (picture.channels != names || picture.width != width || picture.height != height)
            picture_ = Picture(width, height, names);
    }

    Rect region() const override { return {0, 0, picture_.width, picture_.height}; }
    int chunk_height() const override { return picture_.height; }
    const std::vector<ChannelInfo>& channels() const override { return channels_; }

    Plane resident(std::size_t channel) const override { return plane_of(picture_, channel); }
    EncodedChunk encode(int index, std::span<const Plane>) const override { return {index, {}}; }
    void commit(EncodedChunk) override {}
    void finish() override {}

private:
    Picture& picture_;
    std::vector<ChannelInfo> channels_;
};

struct PictureNode {
    static constexpr Info info{"picture", "A picture in memory."};
    struct Params {
        int place = 0;
        static constexpr auto fields = declare(field(&Params::place, "place", "Which of the pictures."));
    };
    explicit PictureNode(const Params& p) : place(static_cast<std::size_t>(p.place)) {}

    Stream read(Builder& builder) const {
        return builder.add_source(std::make_shared<MemorySource>(*shelf().sources[place]));
    }

    const std::size_t place;
};

struct ResultNode {
    static constexpr Info info{"result", "Leaves a picture in memory."};
    struct Params {
        Input in;
        int place = 0;
        static constexpr auto fields = declare(input(&Params::in, "in", "The image."),
                                               field(&Params::place, "place", "Which of the pictures."));
    };
    explicit ResultNode(const Params& p) : in(p.in), place(static_cast<std::size_t>(p.place)) {}

    void write(Builder& builder) const {
        SinkRequest request;
        request.stream = builder.input(in);
        request.spec.display_window = request.stream.display;
        request.spec.data_window = request.stream.window;
        for (const StreamChannel& c : request.stream.channels)
            request.spec.channels.push_back({c.name, SampleType::kFloat});
        request.create = [to = shelf().results[place]](const SinkSpec& spec) {
            return std::make_unique<MemorySink>(spec, *to);
        };
        builder.add_sink(std::move(request));
    }

    const Input in;
    const std::size_t place;
};

void register_nodes() {
    static std::once_flag once;
    std::call_once(once, [] {
        registry().add(make_node_type<PictureNode>());
        registry().add(make_node_type<ResultNode>());
    });
}

[[noreturn]] void throw_all(const Diagnostics& diagnostics) {
    std::string all;
    for (const Error& e : diagnostics.errors()) all += e.text() + "\n";
    throw std::runtime_error(all);
}

ResolvedFrame resolve_nodes(const std::string& nodes, const Picture& source, Picture& result) {
    register_nodes();
    shelf() = {{&source}, {&result}};
    const std::string text = fmt::format(
        R"({{"keyline": 1, "nodes": {{
             "a": {{"type": "picture"}}, "b": {{"type": "picture"}}, {},
             "kept": {{"type": "result", "in": "result"}}}}}})",
        nodes);
    Diagnostics diagnostics;
    const auto graph = Graph::parse(text, "bench.json", ".", {}, diagnostics);
    if (!graph) throw_all(diagnostics);
    auto frame = resolve(*graph, 1, {}, diagnostics);
    if (!frame) throw_all(diagnostics);
    return std::move(*frame);
}

}  // namespace

MemoryGraph::MemoryGraph(const std::string& nodes, const Picture& picture, int threads)
    : result_(std::make_unique<Picture>()),
      frame_(resolve_nodes(nodes, picture, *result_)),
      threads_(threads),
      executor_(threads) {}

Plan MemoryGraph::plan() const { return make_plan(frame_, {threads_, 0, 0}); }

void MemoryGraph::run() { executor_.run(std::make_unique<FrameRun>(plan()), false); }

}  // namespace keyline::bench
