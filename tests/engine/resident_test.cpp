// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/graph/graph.h"
#include "engine/node/node_adaptor.h"
#include "engine/node/registry.h"
#include "engine/plan/planner.h"
#include "engine/run/execute.h"
#include "tests/support/run.h"

// Pictures that lie in memory are read where they are, and made where they are wanted.

namespace keyline::testing {
namespace {

constexpr Rect kWindow{-3, 2, 97, 63};

// Floats row by row, and as many more as a vector may read behind the last.
struct Samples {
    std::vector<float> floats = std::vector<float>(static_cast<std::size_t>(kWindow.area()) + 16);

    Plane plane() {
        return {reinterpret_cast<std::byte*>(floats.data()),
                kWindow.width() * static_cast<std::ptrdiff_t>(sizeof(float)), SampleType::kFloat, kWindow};
    }
};

Samples& given() {
    static Samples samples;
    return samples;
}
Samples& made() {
    static Samples samples;
    return samples;
}

class ResidentSource final : public ImageSource {
public:
    ResidentSource() {
        header_.display_window = header_.data_window = kWindow;
        header_.groups.push_back({{{"Y", SampleType::kFloat}}, kWindow, kWindow.width(), 16});
    }
    const ImageHeader& header() const override { return header_; }
    std::size_t chunk_memory(std::size_t) const override { return 0; }
    Plane resident(std::size_t, std::size_t) const override { return given().plane(); }
    void read_chunk(std::size_t, int, int, std::span<const Plane>) const override {
        fail(ErrorKind::kInternal, "a resident picture was decoded");
    }

private:
    ImageHeader header_;
};

class ResidentSink final : public ImageSink {
public:
    Rect region() const override { return kWindow; }
    int chunk_height() const override { return 16; }
    const std::vector<ChannelInfo>& channels() const override { return channels_; }
    Plane resident(std::size_t) const override { return made().plane(); }
    EncodedChunk encode(int index, std::span<const Plane> planes) const override {
        EXPECT_EQ(planes[0].data, made().plane().at(kWindow.x0, kWindow.y0 + 16 * index));
        return {index, {}};
    }
    void commit(EncodedChunk) override {}
    void finish() override {}

private:
    const std::vector<ChannelInfo> channels_{{"Y", SampleType::kFloat}};
};

struct Given {
    static constexpr Info info{"given", "A picture in memory."};
    struct Params {
        static constexpr auto fields = declare();
    };
    explicit Given(const Params&) {}
    Stream read(Builder& builder) const { return builder.add_source(std::make_shared<ResidentSource>()); }
};

struct Made {
    static constexpr Info info{"made", "Leaves a picture in memory."};
    struct Params {
        Input in;
        static constexpr auto fields = declare(input(&Params::in, "in", "The image."));
    };
    explicit Made(const Params& p) : in(p.in) {}
    void write(Builder& builder) const {
        SinkRequest request;
        request.stream = builder.input(in);
        request.spec.display_window = request.spec.data_window = kWindow;
        request.spec.channels = {{"Y", SampleType::kFloat}};
        request.create = [](const SinkSpec&) { return std::make_unique<ResidentSink>(); };
        builder.add_sink(std::move(request));
    }
    const Input in;
};

constexpr const char* kGraph = R"({ "keyline": 1, "nodes": {
    "in": { "type": "given" },
    "soft": { "type": "gaussian", "in": "in", "sigma": 2 },
    "out": { "type": "made", "in": "soft" } } })";

TEST(Resident, IsReadAndMadeInPlace) {
    registry().add(make_node_type<Given>());
    registry().add(make_node_type<Made>());
    const Image in = noise(kWindow, {"Y"}, 7);
    std::ranges::copy(in.channel("Y").samples, given().floats.begin());
    const std::vector<float> expected = run("gaussian", {{"sigma", 2}}, in).channel("Y").samples;
    for (const int tile : {7, 64, 500}) {
        std::ranges::fill(made().floats, 0.0F);
        Diagnostics diagnostics;
        const auto graph = Graph::parse(kGraph, "resident.json", ".", {}, diagnostics);
        ASSERT_TRUE(graph) << diagnostics.errors().front().text();
        auto frame = resolve(*graph, 1, {}, diagnostics);
        ASSERT_TRUE(frame) << diagnostics.errors().front().text();
        Plan plan = make_plan(std::move(*frame), {.threads = 2, .tile = tile});
        Executor(2).run(std::make_unique<FrameRun>(std::move(plan)), false);
        EXPECT_TRUE(std::ranges::equal(expected, std::span(made().floats).first(expected.size()))) << tile;
    }
    EXPECT_EQ(in.channel("Y").samples[5], given().floats[5]) << "what is given is left as it is";
}

}  // namespace
}  // namespace keyline::testing
