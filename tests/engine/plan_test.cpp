// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/plan.h"

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

TEST(Plan, WhatTakesLessMemoryTakesMoreWork) {
    PlanOptions options;
    options.weigh_all = true;
    const Plan plan = planned(edges_over_blur(), "comp", options);
    ASSERT_GT(plan.weighed.size(), 3U);
    EXPECT_EQ(plan.memory_bytes, plan.weighed.front().memory_bytes) << "without a limit the fastest is taken";
    for (std::size_t i = 1; i < plan.weighed.size(); ++i) {
        EXPECT_LT(plan.weighed[i].memory_bytes, plan.weighed[i - 1].memory_bytes) << i;
        EXPECT_GE(plan.weighed[i].work, plan.weighed[i - 1].work) << i;
    }
    EXPECT_GT(plan.weighed.back().work, 1.1 * plan.weighed.front().work);
}

TEST(Plan, TellsWhatItWeighedAndWhichItTook) {
    PlanOptions options;
    options.weigh_all = true;
    const std::string text = planned(edges_over_blur(), "comp", options).text();
    EXPECT_THAT(text, HasSubstr("\nchoices, from the fastest to the smallest"));
    EXPECT_EQ(std::ranges::count(text, '*'), 1) << text;
    EXPECT_THAT(text, HasSubstr("work 1.00: decode once, compute once, tiles of "));
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

TEST(Plan, TilesOfTheSizeAskedFor) {
    const Plan plan = planned(canny({{"low", 0.1}}), "edges", {1, 17, 0});
    for (const Sweep& s : plan.sweeps) {
        EXPECT_EQ(s.tile_width, 17);
        EXPECT_EQ(s.tile_height, 17);
    }
}

}  // namespace
}  // namespace keyline::testing
