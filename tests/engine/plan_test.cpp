// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/plan/planner.h"
#include "tests/engine/test_nodes.h"
#include "tests/support/run.h"

#include <algorithm>
#include <gmock/gmock.h>

namespace keyline::testing {
namespace {

using ::testing::HasSubstr;

Image passes(const Rect& window = {0, 0, 300, 200}) {
    return noise(window,
                 {"Combined.R", "Combined.G", "Combined.B", "Combined.A", "Normal.X", "Normal.Y", "Normal.Z"},
                 1);
}

Plan planned(const Json& nodes, const std::string& id, const PlanOptions& options = {}) {
    return make_plan(resolve_graph(nodes, {id}, {{"in", {passes()}}}), options);
}

Json canny(const Json& hysteresis) {
    Json edges = hysteresis;
    edges.set("type", "hysteresis").set("in", "thin");
    return {{"grey", {{"type", "ycolor"}, {"in", "in:Combined"}}},
            {"smooth", {{"type", "gaussian"}, {"in", "grey"}}},
            {"slope", {{"type", "gradient"}, {"in", "smooth"}}},
            {"thin", {{"type", "nms"}, {"in", "slope"}}},
            {"edges", edges}};
}

// A picture that needs, after a whole-frame node, what was computed before it.
Json edges_over_blur() {
    Json nodes = canny({{"low", 0.1}});
    nodes.set("soft", {{"type", "gaussian"}, {"in", "in:Combined"}, {"sigma", 5}});
    nodes.set("grey", {{"type", "ycolor"}, {"in", "soft"}});
    nodes.set("ink", {{"type", "ink"}, {"in", "edges"}});
    return nodes.set("comp", {{"type", "over"}, {"fg", "ink"}, {"bg", "soft"}});
}

TEST(Plan, AChainWithoutWholeFrameNodesIsOneSweep) {
    const Plan plan = planned(canny({{"low", 0.1}}), "thin");
    EXPECT_EQ(plan.sweeps.size(), 1U);
    EXPECT_EQ(plan.stores.size(), 1U) << "nothing but decoded samples is stored";
}

TEST(Plan, EachRoundOfAWholeFrameNodeIsASweep) {
    EXPECT_EQ(planned(canny({{"low", 0.1}}), "edges").sweeps.size(), 2U);
    EXPECT_EQ(planned(canny({{"low", 0.1}, {"units", "max"}}), "edges").sweeps.size(), 3U);
    EXPECT_EQ(planned(canny({{"low", 1}, {"high", 2}, {"units", "percentile"}}), "edges").sweeps.size(), 4U);
}

TEST(Plan, OnlyTheChannelsInUseAreRead) {
    const Plan plan = planned(canny({{"low", 0.1}}), "thin");
    EXPECT_EQ(plan.stores.front().values.size(), 3U) << "R, G and B: neither A nor the normals";
    EXPECT_EQ(planned({}, "in:Normal.Y").stores.front().values.size(), 1U);
}

TEST(Plan, OnlyTheRegionInUseIsReadAndComputed) {
    register_test_nodes<Crop>();
    const Json nodes{{"smooth", {{"type", "gaussian"}, {"in", "in:Normal"}, {"sigma", 2}}},
                     {"wide", {{"type", "dilate"}, {"in", "smooth"}, {"radius", 3}}},
                     {"part", {{"type", "cut_out"}, {"in", "wide"}, {"window", {100, 50, 120, 60}}}}};
    const Plan plan = planned(nodes, "part");
    EXPECT_EQ(plan.stores.front().region, (Rect{100 - 8, 50 - 8, 120 + 8, 60 + 8}));
    EXPECT_EQ(plan.sweeps.front().area, (Rect{100, 50, 120, 60}));
}

TEST(Plan, WhatLiesBetweenOutputsFarApartIsNotTiled) {
    const Json nodes{{"away", {{"type", "transform"}, {"in", "in"}, {"translate", {900'000, 900'000}}}}};
    const Plan plan = make_plan(resolve_graph(nodes, {"in", "away"}, {{"in", {passes()}}}), {.tile = 50});
    EXPECT_GT(plan.sweeps.front().area.width(), 900'000);
    EXPECT_LE(plan.sweeps.front().columns.size(), 2 * (300U / 50 + 2));
    EXPECT_LE(plan.sweeps.front().rows.size(), 2 * (200U / 50 + 2));
}

TEST(Plan, AtTheEdgeNothingOutsideTheWindowIsDemanded) {
    register_test_nodes<Crop>();
    const Json nodes{{"smooth", {{"type", "gaussian"}, {"in", "in:Normal"}, {"sigma", 2}}},
                     {"part", {{"type", "cut_out"}, {"in", "smooth"}, {"window", {290, 0, 999, 3}}}}};
    EXPECT_EQ(planned(nodes, "part").stores.front().region, (Rect{290 - 5, 0, 300, 3 + 5}));
}

TEST(Plan, AWholeFrameNodeNeedsItsWholeInput) {
    register_test_nodes<Crop>();
    Json nodes = canny({{"low", 0.1}});
    nodes.set("part", {{"type", "cut_out"}, {"in", "edges"}, {"window", {0, 0, 5, 5}}});
    EXPECT_EQ(planned(nodes, "part").stores.front().region, (Rect{0, 0, 300, 200}));
}

std::size_t computed_stores(const Plan& plan) {
    return static_cast<std::size_t>(std::ranges::count(plan.stores, -1, &Store::source_op));
}

TEST(Plan, KeepsWhatALaterSweepNeedsAgain) {
    EXPECT_GT(computed_stores(planned(edges_over_blur(), "comp")), 0U);
    EXPECT_EQ(computed_stores(planned(canny({{"low", 0.1}}), "edges")), 0U);
}

std::string refusal(const Json& nodes, std::size_t memory) {
    try {
        planned(nodes, "comp", {1, 0, memory});
        return "";
    } catch (const Failure& f) {
        EXPECT_EQ(f.error().kind, ErrorKind::kGraph);
        return f.error().what + "; " + f.error().hint;
    }
}

// "give --memory 26M"
std::size_t least_told(const std::string& text) {
    const auto at = text.find("give --memory ");
    return at == std::string::npos ? 0 : std::stoul(text.substr(at + 14)) << 20;
}

TEST(Plan, RefusesTooLittleMemoryAndSaysTheLeast) {
    const std::string text = refusal(edges_over_blur(), std::size_t{1} << 20);
    EXPECT_THAT(text, HasSubstr("the memory limit is 1M; frame 1 needs at least "));
    const std::size_t least = least_told(text);
    ASSERT_GT(least, 0U) << text;
    EXPECT_EQ(refusal(edges_over_blur(), least), "");
    EXPECT_LE(planned(edges_over_blur(), "comp", {1, 0, least}).memory_bytes, least);
}

TEST(Plan, ComputesAgainWhatItHasNoMemoryToKeep) {
    std::size_t memory = planned(edges_over_blur(), "comp").memory_bytes;
    std::size_t fewest = 99;
    try {
        for (;;) {
            const Plan plan = planned(edges_over_blur(), "comp", {1, 0, memory});
            fewest = std::min(fewest, computed_stores(plan));
            memory = plan.memory_bytes - 1;
        }
    } catch (const Failure& f) {
        EXPECT_THAT(f.error().what, HasSubstr("needs at least"));
    }
    EXPECT_EQ(fewest, 0U);
}

TEST(Plan, WhatTakesLessMemoryTakesMoreTime) {
    PlanOptions options;
    options.weigh_all = true;
    const Plan plan = planned(edges_over_blur(), "comp", options);
    ASSERT_GT(plan.weighed.size(), 3U);
    EXPECT_EQ(plan.memory_bytes, plan.weighed.front().memory_bytes) << "without a limit the fastest is taken";
    for (std::size_t i = 1; i < plan.weighed.size(); ++i) {
        EXPECT_LT(plan.weighed[i].memory_bytes, plan.weighed[i - 1].memory_bytes) << i;
        EXPECT_GE(plan.weighed[i].seconds, 0.9 * plan.weighed[i - 1].seconds) << i;
    }
    EXPECT_GT(plan.weighed.back().seconds, 1.1 * plan.weighed.front().seconds);
}

TEST(Plan, TellsWhatItWeighedAndWhichItTook) {
    PlanOptions options;
    options.weigh_all = true;
    const std::string text = planned(edges_over_blur(), "comp", options).text();
    EXPECT_THAT(text, HasSubstr("\nchoices, from the roomiest to the smallest"));
    EXPECT_EQ(std::ranges::count(text, '*'), 1) << text;
    EXPECT_THAT(text, HasSubstr("time 1.00: decode once, compute once, tiles of "));
    EXPECT_EQ(planned(edges_over_blur(), "comp").text().find("choices"), std::string::npos);
}

// A tile pays for its halo in what the operations before it compute again.
TEST(Plan, LargeHalosGetLargeTiles) {
    const Image large = noise({0, 0, 2000, 1000}, {"Y"}, 1);
    const auto tile_area = [&](double sigma) {
        const Json nodes{{"blur", {{"type", "gaussian"}, {"in", "in"}, {"sigma", sigma}}},
                         {"again", {{"type", "gaussian"}, {"in", "blur"}, {"sigma", sigma}}}};
        const Plan plan = make_plan(resolve_graph(nodes, {"again"}, {{"in", {large}}}), {});
        return plan.sweeps.front().tile_width * plan.sweeps.front().tile_height;
    };
    EXPECT_LT(tile_area(1), tile_area(60));
}

// A picture of that size that nothing is read for: a plan is made of windows alone.
Json plate(int width, int height) {
    return {{"type", "constant"}, {"color", {0.5, 0.5, 0.5}}, {"size", {width, height}}};
}

Plan planned_for(int threads, const Json& nodes, const std::string& id, std::size_t memory = 0) {
    PlanOptions options;
    options.threads = threads;
    options.memory = memory;
    return make_plan(resolve_graph(nodes, {id}, {}), options);
}

std::size_t fewest_tiles(const Plan& plan) {
    std::size_t fewest = SIZE_MAX;
    for (const Sweep& s : plan.sweeps) fewest = std::min(fewest, s.columns.size() * s.rows.size());
    return fewest;
}

struct Shrinking {
    const char* name;
    Json nodes;
};

std::vector<Shrinking> shrinking() {
    return {{"in half",
             {{"in", plate(3840, 2160)},
              {"half", {{"type", "reformat"}, {"in", "in"}, {"size", {1920, 1080}}}},
              {"small", {{"type", "gaussian"}, {"in", "half"}, {"sigma", 2}}}}},
            {"larger, then in half",
             {{"in", plate(1920, 1080)},
              {"large", {{"type", "reformat"}, {"in", "in"}, {"size", {3840, 2160}}}},
              {"soft", {{"type", "gaussian"}, {"in", "large"}, {"sigma", 2}}},
              {"small", {{"type", "reformat"}, {"in", "soft"}, {"size", {1920, 1080}}}}}},
            {"to a tenth",
             {{"in", plate(7680, 4320)},
              {"small", {{"type", "transform"}, {"in", "in"}, {"scale", 0.1}, {"rotate", 10}}}}},
            {"cut out and blurred",
             {{"in", plate(7680, 4320)},
              {"part", {{"type", "crop"}, {"in", "in"}, {"region", {1000, 1000, 1920, 1080}}}},
              {"small", {{"type", "gaussian"}, {"in", "part"}, {"sigma", 60}}}}}};
}

// What is read for a tile grows with the tile here, and no tile is large enough to change that.
TEST(Plan, APictureMadeSmallerIsSharedByAllThreads) {
    constexpr int kThreads = 16;
    for (const Shrinking& graph : shrinking()) {
        const Plan plan = planned_for(kThreads, graph.nodes, "small");
        EXPECT_GE(fewest_tiles(plan), 3U * kThreads) << graph.name << '\n' << plan.text();
        EXPECT_LE(plan.memory_bytes, std::size_t{768} << 20) << graph.name << '\n' << plan.text();
    }
}

// One thread has no one to share with, but its caches have room for so much only.
TEST(Plan, APictureMadeSmallerIsNotOneTile) {
    for (const Shrinking& graph : shrinking()) {
        const Plan plan = planned_for(1, graph.nodes, "small");
        EXPECT_GE(fewest_tiles(plan), 4U) << graph.name << '\n' << plan.text();
        EXPECT_LE(plan.memory_bytes, std::size_t{512} << 20) << graph.name << '\n' << plan.text();
    }
}

// Work in fewer tiles than there are threads is not divided by them.
TEST(Plan, FewTilesAreNotSharedByManyThreads) {
    const Json nodes{{"in", plate(2000, 1000)}, {"out", {{"type", "gaussian"}, {"in", "in"}, {"sigma", 3}}}};
    const auto gain = [&](int tile) {
        const auto seconds = [&](int threads) {
            return make_plan(resolve_graph(nodes, {"out"}, {}), {.threads = threads, .tile = tile}).seconds;
        };
        return seconds(1) / seconds(16);
    };
    EXPECT_LT(gain(2000), 10) << "one tile; only encoding is shared";
    EXPECT_LT(1.05 * gain(2000), gain(1000));
    EXPECT_LT(1.05 * gain(1000), gain(250));
}

// Sizes whose products leave an int: all of them are told, and the smallest is found.
TEST(Plan, WindowsOfAnySizeAreWeighed) {
    for (const int size : {46341, 65536, 1 << 20}) {
        const Json nodes{{"in", plate(size, size)},
                         {"out", {{"type", "gaussian"}, {"in", "in"}, {"sigma", 500}}}};
        ResolvedFrame frame = resolve_graph(nodes, {"out"}, {});
        PlanOptions options;
        options.threads = 2;
        options.weigh_all = true;
        const Plan plan = make_plan(std::move(frame), options);
        EXPECT_LE(plan.weighed.back().tile_width * plan.weighed.back().tile_height, 64) << size;
        EXPECT_LT(plan.weighed.back().memory_bytes, std::size_t{1} << 34) << size;
        EXPECT_GT(plan.seconds, 0) << size;
    }
}

TEST(Plan, TheLargestTileOfTheMostThreadsIsNoMoreThanThePicture) {
    const Json nodes{{"in", plate(300, 200)}, {"out", {{"type", "gaussian"}, {"in", "in"}}}};
    PlanOptions options;
    options.threads = 1024;
    options.tile = 1 << 20;
    const Plan plan = make_plan(resolve_graph(nodes, {"out"}, {}), options);
    EXPECT_EQ(fewest_tiles(plan), 1U);
    EXPECT_LT(plan.memory_bytes, std::size_t{8} << 30);
}

// A tile between two windows far apart says nothing of those in them.
TEST(Plan, WindowsFarApartAreEstimatedByWhatLiesInThem) {
    const auto far = [](double by) {
        return Json{{"in", plate(300, 200)},
                    {"soft", {{"type", "gaussian"}, {"in", "in"}, {"sigma", 3}}},
                    {"away", {{"type", "transform"}, {"in", "soft"}, {"translate", {by, -by}}}}};
    };
    const Plan near = make_plan(resolve_graph(far(0.5), {"soft", "away"}, {}), {.tile = 50});
    const Plan away = make_plan(resolve_graph(far(900'000), {"soft", "away"}, {}), {.tile = 50});
    EXPECT_GT(away.sweeps.front().scratch_bytes, near.sweeps.front().scratch_bytes / 4);
    EXPECT_GT(away.seconds, near.seconds / 2);
    EXPECT_LT(away.seconds, near.seconds * 4);
}

TEST(Plan, TilesOfTheSizeAskedFor) {
    const Plan plan = planned(canny({{"low", 0.1}}), "edges", {1, 17, 0});
    for (const Sweep& s : plan.sweeps) {
        EXPECT_EQ(s.tile_width, 17);
        EXPECT_EQ(s.tile_height, 17);
    }
}

}  // namespace
}  // namespace keyline::testing
