// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/nodes/plate.h"

// shuffle, pack and crop: what moves channels without computing any.

namespace keyline::testing {
namespace {

using Images = std::map<std::string, Image>;

std::vector<std::string> names(const Image& image) {
    std::vector<std::string> out;
    for (const Image::Channel& c : image.channels) out.push_back(c.name);
    return out;
}

TEST(Shuffle, RenamesAndFills) {
    const Image in = noise({-3, 1, 8, 9}, {"R", "G", "depth.Z"}, 1);
    const Image out =
        run("shuffle", {{"channels", {{"R", "Z"}, {"G", "R"}, {"new.A", 1}, {"Y", "depth.Z"}}}}, in);
    EXPECT_EQ(names(out), (std::vector<std::string>{"R", "G", "new.A", "Y"}));
    EXPECT_EQ(out.window, in.window);
    EXPECT_EQ(out.channel("R").samples, in.channel("depth.Z").samples);
    EXPECT_EQ(out.channel("G").samples, in.channel("R").samples);
    EXPECT_EQ(out.channel("Y").samples, in.channel("depth.Z").samples);
    EXPECT_EQ(out.at("new.A", 7, 8), 1);
}

TEST(Shuffle, KeepsTheTypeOfTheFile) {
    Image in = noise({0, 0, 3, 3}, {"Z"}, 2);
    in.channel("Z").type = SampleType::kHalf;
    EXPECT_EQ(run("shuffle", {{"channels", {{"R", "Z"}}}}, in).channel("R").type, SampleType::kHalf);
}

TEST(Shuffle, SaysWhatIsNotThere) {
    const Image in = noise({0, 0, 1, 1}, {"Normal.X", "Normal.Y"}, 3);
    const std::string missing = error_of("shuffle", {{"channels", {{"R", "Normal.W"}}}}, in);
    EXPECT_NE(missing.find("'Normal.W'"), std::string::npos) << missing;
    const std::string layer = error_of("shuffle", {{"channels", {{"R", "Normal"}}}}, in);
    EXPECT_NE(layer.find("'Normal' is a layer of 2 channels"), std::string::npos) << layer;
}

TEST(Pack, MakesLayers) {
    Image a = noise({0, 0, 4, 4}, {"R", "A"}, 4);
    a.display = {0, 0, 10, 10};
    const Image b = noise({2, -1, 6, 3}, {"Z"}, 5);
    const Image out = run_graph({{"p", {{"type", "pack"}, {"layers", {{"", "a"}, {"depth", "b"}}}}}}, "p",
                                Images{{"a", a}, {"b", b}});
    EXPECT_EQ(names(out), (std::vector<std::string>{"R", "A", "depth.Z"}));
    EXPECT_EQ(out.window, (Rect{0, -1, 6, 4}));
    EXPECT_EQ(out.display, a.display);
    EXPECT_EQ(out.at("R", 3, 3), a.at("R", 3, 3));
    EXPECT_EQ(out.at("R", 5, 0), 0);
    EXPECT_EQ(out.at("depth.Z", 5, -1), b.at("Z", 5, -1));
    EXPECT_EQ(out.at("depth.Z", 0, 0), 0);
}

TEST(Pack, RefusesTheSameChannelTwice) {
    const Image a = noise({0, 0, 1, 1}, {"R", "x.R"}, 6);
    try {
        run_graph({{"p", {{"type", "pack"}, {"layers", {{"", "a"}, {"x", "a:R"}}}}}}, "p", Images{{"a", a}});
        FAIL();
    } catch (const Failure& f) {
        EXPECT_NE(f.error().what.find("two layers have a channel 'x.R'"), std::string::npos);
    }
}

TEST(Crop, KeepsARegion) {
    Image in = noise({-5, -5, 20, 10}, {"R", "Z"}, 7);
    in.channel("Z").type = SampleType::kHalf;
    const Image out = run("crop", {{"region", {-2, 3, 9, 100}}}, in);
    EXPECT_EQ(out.window, (Rect{-2, 3, 7, 10}));
    EXPECT_EQ(out.display, in.display);
    EXPECT_EQ(out.channel("Z").type, SampleType::kHalf);
    for (int y = 3; y < 10; ++y)
        for (int x = -2; x < 7; ++x) ASSERT_EQ(out.at("R", x, y), in.at("R", x, y));
}

// A channel that only passes through the nodes after it must not show again what was cut off.
TEST(Crop, StaysInForceUnderAWiderWindow) {
    const Image in = noise({0, 0, 8, 8}, {"R", "G", "B", "A", "Z"}, 8, 1, 2);
    const Image out = run_graph({{"c", {{"type", "crop"}, {"in", "in"}, {"region", {2, 2, 3, 3}}}},
                                 {"o", {{"type", "over"}, {"fg", "in"}, {"bg", "c"}}}},
                                "o", Images{{"in", in}});
    EXPECT_EQ(out.window, in.window);
    EXPECT_EQ(out.at("Z", 3, 3), in.at("Z", 3, 3));
    EXPECT_EQ(out.at("Z", 1, 3), 0);
    EXPECT_EQ(out.at("Z", 5, 4), 0);
}

TEST(Crop, OfNothingIsEmpty) {
    const Image in = noise({0, 0, 8, 8}, {"Y"}, 9);
    EXPECT_TRUE(run("crop", {{"region", {20, 20, 5, 5}}}, in).window.empty());
    EXPECT_NE(error_of("crop", {{"region", {0, 0, -1, 5}}}, in).find("-1 × 5 pixels"), std::string::npos);
}

}  // namespace
}  // namespace keyline::testing
