// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/plan/resolve.h"

#include "tests/engine/test_nodes.h"
#include "tests/support/interpret.h"
#include "tests/support/run.h"

#include <functional>
#include <gmock/gmock.h>
#include <pthread.h>

namespace keyline::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Image passes() {
    Image image = noise({-3, 2, 30, 21},
                        {"ViewLayer.Combined.R", "ViewLayer.Combined.G", "ViewLayer.Combined.B",
                         "ViewLayer.Combined.A", "ViewLayer.Depth.Z", "Normal.X", "Normal.Y"},
                        1);
    image.display = {0, 0, 32, 24};
    image.channels[4].type = SampleType::kUint;
    image.metadata.set({"artist", "string", std::string("me")});
    return image;
}

const Stream& result(const ResolvedFrame& frame) { return frame.sinks.front().request.stream; }

// Half a megabyte, as some systems give a thread.
void on_a_small_stack(const std::function<void()>& run) {
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    pthread_attr_setstacksize(&attributes, std::size_t{1} << 19);
    pthread_t thread = 0;
    const auto start = [](void* f) -> void* {
        (*static_cast<const std::function<void()>*>(f))();
        return nullptr;
    };
    ASSERT_EQ(pthread_create(&thread, &attributes, start, const_cast<std::function<void()>*>(&run)), 0);
    pthread_join(thread, nullptr);
    pthread_attr_destroy(&attributes);
}

std::string error_in(const Json& nodes, const std::string& id) {
    try {
        resolve_graph(nodes, {id}, {{"in", {passes()}}});
        return "";
    } catch (const Failure& f) {
        return f.error().what;
    }
}

TEST(Resolve, CarriesWindowsChannelsAndMetadataFromTheHeader) {
    const ResolvedFrame frame = resolve_graph({}, {"in"}, {{"in", {passes()}}});
    EXPECT_EQ(result(frame).display, (Rect{0, 0, 32, 24}));
    EXPECT_EQ(result(frame).window, (Rect{-3, 2, 30, 21}));
    EXPECT_EQ(result(frame).names().size(), 7U);
    EXPECT_NE(result(frame).metadata->find("artist"), nullptr);
}

TEST(Resolve, ALayerLosesItsPrefix) {
    const ResolvedFrame frame = resolve_graph({}, {"in:Combined"}, {{"in", {passes()}}});
    EXPECT_THAT(result(frame).names(), ElementsAre("R", "G", "B", "A"));
    EXPECT_THAT(result(resolve_graph({}, {"in:ViewLayer."}, {{"in", {passes()}}})).names(),
                ElementsAre("Combined.R", "Combined.G", "Combined.B", "Combined.A", "Depth.Z"));
}

TEST(Resolve, SaysWhichLayersHaveWhatANodeNeeds) {
    EXPECT_THAT(error_in({{"y", {{"type", "ycolor"}, {"in", "in:Normal"}}}}, "y"),
                HasSubstr("node 'y' (ycolor): "));
    EXPECT_THAT(error_in({{"y", {{"type", "ycolor"}, {"in", "in"}}}}, "y"), HasSubstr("ViewLayer.Combined"));
    EXPECT_THAT(error_in({{"y", {{"type", "ycolor"}, {"in", "in:Combinde"}}}}, "y"), HasSubstr("Combined"));
}

TEST(Resolve, ToldErrorsAreNotToldAgainByWhatFollows) {
    const std::string text = error_in({{"y", {{"type", "ycolor"}, {"in", "in:Normal"}}},
                                       {"blur", {{"type", "gaussian"}, {"in", "y"}}},
                                       {"slope", {{"type", "gradient"}, {"in", "blur"}}}},
                                      "slope");
    EXPECT_EQ(std::ranges::count(text, '\n'), 1) << text;
}

TEST(Resolve, OtherChannelsOfTheBackgroundKeepTheirType) {
    Image bg = noise({0, 0, 8, 8}, {"R", "G", "B", "id.X"}, 3);
    bg.channels[3].type = SampleType::kUint;
    const Image fg({0, 0, 4, 4}, {"R", "G", "B", "A"});
    const ResolvedFrame frame = resolve_graph({{"comp", {{"type", "over"}, {"fg", "fg"}, {"bg", "bg"}}}},
                                              {"comp"}, {{"bg", {bg}}, {"fg", {fg}}});
    const StreamChannel* id = result(frame).find("id.X");
    ASSERT_NE(id, nullptr);
    EXPECT_EQ(frame.info(id->value).stored, SampleType::kUint);
    EXPECT_EQ(frame.info(result(frame).find("R")->value).stored, std::nullopt);
}

TEST(Resolve, WhatChangesNothingIsNotThere) {
    const Json nodes{{"blur", {{"type", "gaussian"}, {"in", "in:Normal"}, {"sigma", 0}}},
                     {"bold", {{"type", "dilate"}, {"in", "blur"}, {"radius", 0}}}};
    EXPECT_EQ(resolve_graph(nodes, {"bold"}, {{"in", {passes()}}}).ops.size(), 1U);
}

TEST(Resolve, ANodeMayAskForAnotherFrameOfItsInput) {
    register_test_nodes<Change>();
    std::vector<Image> frames;
    for (int f = 0; f < 4; ++f) frames.push_back(noise({3, 0, 20, 15}, {"Y"}, static_cast<unsigned>(f)));
    const Json nodes{{"wide", {{"type", "dilate"}, {"in", "in"}}},
                     {"change", {{"type", "change"}, {"in", "wide"}, {"since", 2}}}};
    const Image now = run("dilate", {}, frames[3]), then = run("dilate", {}, frames[1]);
    Image expected = now;
    expected.fill("Y", [&](int x, int y) { return std::as_const(now).at("Y", x, y) - then.at("Y", x, y); });
    for (const int tile : {4, 100})
        EXPECT_IMAGE(run_graph(nodes, "change", Sequences{{"in", frames}}, {.tile = tile, .frame = 3}),
                     expected);
}

TEST(Resolve, AFrameThatSeveralNodesAskForIsThereOnce) {
    register_test_nodes<Change>();
    const Json nodes{{"wide", {{"type", "dilate"}, {"in", "in"}}},
                     {"a", {{"type", "change"}, {"in", "wide"}, {"since", 1}}},
                     {"b", {{"type", "change"}, {"in", "a"}, {"since", 1}}}};
    const std::vector<Image> frames(4, noise({0, 0, 5, 5}, {"Y"}, 1));
    const ResolvedFrame frame = resolve_graph(nodes, {"b"}, {{"in", frames}}, 3);
    // Frames 3, 2 and 1 of source and dilate, frames 3 and 2 of a, and b.
    EXPECT_EQ(frame.ops.size(), 9U);
}

TEST(Resolve, AnErrorInAnotherFrameIsToldOnce) {
    register_test_nodes<Change>();
    const Json nodes{{"y", {{"type", "ycolor"}, {"in", "in:Normal"}}},
                     {"a", {{"type", "change"}, {"in", "y"}}}};
    EXPECT_EQ(std::ranges::count(error_in(nodes, "a"), '\n'), 1);
}

// Every level of a recursion would take about a kilobyte of the stack.
TEST(Resolve, AChainThroughAnotherFrameMayBeLong) {
    register_test_nodes<Change, Crop>();
    Json nodes;
    const int length = 3000;
    std::string last = "in";
    for (int i = 0; i < length; ++i) {
        const std::string name = "n" + std::to_string(i);
        nodes.set(name, {{"type", "cut_out"}, {"in", last}, {"window", {0, 0, 4, 4}}});
        last = name;
    }
    nodes.set("change", {{"type", "change"}, {"in", last}});
    const std::vector<Image> frames(3, noise({0, 0, 4, 4}, {"Y"}, 1));
    std::size_t ops = 0;
    on_a_small_stack([&] { ops = resolve_graph(nodes, {"change"}, {{"in", frames}}, 2).ops.size(); });
    EXPECT_EQ(ops, 3U) << "two frames of the source, and the difference";
}

TEST(Resolve, ANodeThatMovesPixelsGetsThoseItDemands) {
    register_test_nodes<Shift>();
    const Image in = noise({-4, 3, 50, 40}, {"Y"}, 2);
    Image expected = in;
    expected.fill("Y", [&](int x, int y) { return in.at("Y", x - 7, y + 12); });
    for (const int tile : {5, 16, 100})
        EXPECT_IMAGE(run("shift", {{"by", {7, -12}}}, in, {.tile = tile}), expected);
}

}  // namespace
}  // namespace keyline::testing
