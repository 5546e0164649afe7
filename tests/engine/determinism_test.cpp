// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/node/registry.h"
#include "engine/plan/planner.h"
#include "engine/plan/resolve.h"
#include "tests/support/draw.h"
#include "tests/support/interpret.h"
#include "tests/support/targets.h"

#include <algorithm>
#include <fmt/format.h>

// Random graphs give the same bytes under every schedule, and those of the plain evaluation.

namespace keyline::testing {
namespace {

struct RandomGraph {
    Json nodes;
    std::vector<std::string> ids, outputs;
    Sequences inputs;

    ResolvedFrame resolve() const { return resolve_graph(nodes, outputs, inputs); }
};

Image layered_image(Draw& draw) {
    Image image =
        noise(draw.window(130, 90), {"R", "G", "B", "A", "Normal.X", "Normal.Y", "Normal.Z", "depth.Z"},
              static_cast<unsigned>(draw.whole(0, 1 << 20)), -0.25F, 1);
    image.display = {0, 0, 60, 40};
    for (Image::Channel& c : image.channels)
        if (draw.one_in(2)) c.type = SampleType::kHalf;
    return image;
}

// Keyline's own: other tests of this program register nodes that misbehave.
std::vector<const NodeType*> computing_types() {
    std::vector<const NodeType*> out;
    for (const Room& room : built_in_nodes())
        for (const NodeType& built_in : room.types) {
            const NodeType* type = registry().find(built_in.name);
            if (!has_files(*type) && type->gives.empty() && type->kind != NodeKind::kSource &&
                type->kind != NodeKind::kSink)
                out.push_back(type);
        }
    return out;
}

// What can be known of images without their samples, which would be copied a thousand times.
Sequences without_samples(const Sequences& inputs) {
    Sequences out = inputs;
    for (auto& [id, images] : out)
        for (Image& image : images)
            for (Image::Channel& c : image.channels) c.samples.clear();
    return out;
}

// Nodes that enlarge, one after the other, would make images that take minutes.
bool small(const ResolvedFrame& frame) {
    return std::ranges::all_of(frame.ops, [](const Op& op) {
        return std::ranges::all_of(op.outputs, [](const ValueInfo& v) { return v.window.area() <= 40'000; });
    });
}

bool suits(const RandomGraph& graph) {
    try {
        return small(graph.resolve());
    } catch (const Failure&) {
        return false;
    }
}

// A node on what is there already; drawn again until its inputs suit it.
void add_node(RandomGraph& graph, const NodeType& type, Draw& draw) {
    const std::string id = fmt::format("n{}", graph.ids.size());
    const auto input = [&](const TypeInfo&) {
        return draw.of(graph.ids) + draw.of<std::string>({"", "", "", ":Normal", ":depth", ":A", ":."});
    };
    for (int tries = 0; tries < 30; ++tries) {
        RandomGraph larger = graph;
        larger.nodes.set(id, draw.parameters(type, input));
        larger.ids.push_back(id);
        larger.outputs = {id};
        if (!suits(larger)) continue;
        graph = std::move(larger);
        return;
    }
}

RandomGraph random_graph(unsigned seed) {
    static const std::vector<const NodeType*> types = computing_types();
    Draw draw(seed);
    Sequences inputs;
    for (const char* id : {"a", "b"})
        for (int frame = 0; frame < 3; ++frame) inputs[id].push_back(layered_image(draw));
    RandomGraph graph{{}, {"a", "b"}, {}, without_samples(inputs)};
    for (int n = draw.whole(4, 9); n > 0; --n) add_node(graph, *draw.of(types), draw);
    graph.outputs = {graph.ids.back(), draw.of(graph.ids), draw.of(graph.ids)};
    graph.inputs = std::move(inputs);
    return graph;
}

class RandomGraphs : public ::testing::TestWithParam<unsigned> {
protected:
    void expect_same(const PlanOptions& options) {
        const std::vector<Image> actual = render(make_plan(graph_.resolve(), options));
        ASSERT_EQ(actual.size(), expected_.size());
        for (std::size_t i = 0; i < actual.size(); ++i)
            EXPECT_TRUE(same(actual[i], expected_[i]))
                << graph_.outputs[i] << " with tiles of " << options.tile << ", " << options.threads
                << " threads, memory " << options.memory << ": "
                << compare_images("", "", actual[i], expected_[i]).message() << graph_.nodes.text();
    }

    const RandomGraph graph_ = random_graph(GetParam());
    const std::vector<Image> expected_ = interpret(graph_.resolve());
};

TEST_P(RandomGraphs, GiveTheSameBytesForEveryTileAndThread) {
    for (const int tile : {0, 13, 64, 500})
        for (const int threads : {1, 2, 5}) expect_same({threads, tile, 0});
}

TEST_P(RandomGraphs, GiveTheSameBytesOnEveryInstructionSet) {
    test::on_every_target([this] { expect_same({2, 64, 0}); });
}

// From what the planner likes best down to the least that it can do, each plan that there is between.
TEST_P(RandomGraphs, GiveTheSameBytesInLittleMemory) {
    std::size_t memory = make_plan(graph_.resolve(), {2, 0, 0}).memory_bytes;
    int plans = 0;
    try {
        for (;; ++plans) {
            expect_same({2, 0, memory});
            memory = make_plan(graph_.resolve(), {2, 0, memory}).memory_bytes - 1;
        }
    } catch (const Failure& f) {
        EXPECT_NE(f.error().what.find("needs at least"), std::string::npos) << f.what();
    }
    EXPECT_GT(plans, 0);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomGraphs, ::testing::Range(0U, 24U));

TEST(RandomGraphs, OfOnePixelTilesTheSame) {
    const Image in = noise({-3, -2, 21, 17}, {"R", "G", "B", "A"}, 5);
    const Json nodes{{"grey", {{"type", "ycolor"}, {"in", "in"}}},
                     {"slope", {{"type", "gradient"}, {"in", "grey"}}},
                     {"thin", {{"type", "nms"}, {"in", "slope"}}},
                     {"edges", {{"type", "hysteresis"}, {"in", "thin"}, {"low", 0.2}}},
                     {"bold", {{"type", "dilate"}, {"in", "edges"}}},
                     {"ink", {{"type", "ink"}, {"in", "bold"}}},
                     {"comp", {{"type", "over"}, {"fg", "ink"}, {"bg", "in"}}}};
    const Image whole = run_graph(nodes, "comp", Sequences{{"in", {in}}}, {.threads = 1, .tile = 500});
    EXPECT_IMAGE(run_graph(nodes, "comp", Sequences{{"in", {in}}}, {.threads = 5, .tile = 1}), whole);
}

}  // namespace
}  // namespace keyline::testing
