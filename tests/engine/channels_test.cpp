// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/base/channels.h"

#include "engine/base/error.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <iterator>
#include <sstream>

namespace keyline {
namespace {

using Names = std::vector<std::string>;

// Channel names from a line of them.
Names names(const std::string& line) {
    std::istringstream in(line);
    return {std::istream_iterator<std::string>(in), {}};
}

// What is taken, as "was>becomes was>becomes".
std::string picked(const std::string& line, std::string_view selection) {
    const Names from = names(line);
    std::string out;
    for (const Picked& p : select_channels(from, selection))
        out += fmt::format("{}{}>{}", out.empty() ? "" : " ", from[p.index], p.name);
    return out;
}

template <typename F>
std::string fault(const F& f) {
    try {
        f();
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.error().kind, ErrorKind::kGraph);
        return failure.what();
    }
    return "no failure";
}

std::string pick_fault(const std::string& line, std::string_view selection) {
    return fault([&] { picked(line, selection); });
}

const std::string kRender =
    "ViewLayer.Combined.A ViewLayer.Combined.B ViewLayer.Combined.G ViewLayer.Combined.R ViewLayer.Depth.Z "
    "ViewLayer.Normal.X ViewLayer.Normal.Y ViewLayer.Normal.Z";

TEST(Channels, SplitAtTheLastDot) {
    EXPECT_EQ(split_channel("ViewLayer.Combined.R").layer, "ViewLayer.Combined");
    EXPECT_EQ(split_channel("ViewLayer.Combined.R").base, "R");
    EXPECT_EQ(split_channel("R").layer, "");
    EXPECT_EQ(split_channel("R").base, "R");
    EXPECT_EQ(join_channel("a.b", "R"), "a.b.R");
    EXPECT_EQ(join_channel("", "R"), "R");
}

TEST(Channels, LayersComeInOrderOfAppearance) {
    EXPECT_EQ(layers_of(names("R z.R a.R z.G a.b.R")), (Names{"z", "a", "a.b"}));
    EXPECT_EQ(layers_of(names("R G")), Names{});
}

struct Pick {
    std::string channels, selection, result;
};

class Select : public testing::TestWithParam<Pick> {};

TEST_P(Select, Takes) {
    EXPECT_EQ(picked(GetParam().channels, GetParam().selection), GetParam().result)
        << GetParam().channels << " : " << GetParam().selection;
}

INSTANTIATE_TEST_SUITE_P(
    Rules, Select,
    testing::Values(
        Pick{kRender, "ViewLayer.Depth", "ViewLayer.Depth.Z>Z"},
        Pick{kRender, "Normal", "ViewLayer.Normal.X>X ViewLayer.Normal.Y>Y ViewLayer.Normal.Z>Z"},
        Pick{kRender, "ViewLayer.Normal.Y", "ViewLayer.Normal.Y>Y"},
        Pick{kRender, "Normal.Y", "ViewLayer.Normal.Y>Y"}, Pick{kRender, "R", "ViewLayer.Combined.R>R"},
        Pick{"R G B", "G", "G>G"},
        // A full layer goes before a full channel, that before the end of a layer, that before a channel's.
        Pick{"a a.X a.Y", "a", "a.X>X a.Y>Y"}, Pick{"Z b.Z.X", "Z", "Z>Z"}, Pick{"b.Z.X c.Z", "Z", "b.Z.X>X"},
        Pick{"a.b.X c.a.b.Y", "a.b", "a.b.X>X"},
        // A layer is not what lies below it.
        Pick{"a.R a.b.R", "a", "a.R>R"},
        // Ends start at a dot.
        Pick{"x.Depth.Z DeepDepth.Z", "Depth", "x.Depth.Z>Z"},
        Pick{
            kRender, "ViewLayer.",
            "ViewLayer.Combined.A>Combined.A ViewLayer.Combined.B>Combined.B ViewLayer.Combined.G>Combined.G "
            "ViewLayer.Combined.R>Combined.R ViewLayer.Depth.Z>Depth.Z ViewLayer.Normal.X>Normal.X "
            "ViewLayer.Normal.Y>Normal.Y ViewLayer.Normal.Z>Normal.Z"},
        Pick{"a.R a.b.R a.b.c.R ab.d.R x.a.b.R", "a.", "a.b.R>b.R a.b.c.R>b.c.R"},
        Pick{"R a.R Z", ".", "R>R Z>Z"}));

TEST(Select, SaysWhatThereIs) {
    EXPECT_EQ(
        pick_fault(kRender, "Normals"),
        "error: no layer or channel 'Normals'; there are the layers 'ViewLayer.Combined', 'ViewLayer.Depth' "
        "and 'ViewLayer.Normal'; did you mean 'Normal'?");
    EXPECT_EQ(pick_fault(kRender, "ViewLayer.Norml"),
              "error: no layer or channel 'ViewLayer.Norml'; there are the layers 'ViewLayer.Combined', "
              "'ViewLayer.Depth' and 'ViewLayer.Normal'; did you mean 'ViewLayer.Normal'?");
    EXPECT_EQ(pick_fault("R G", "alpha"),
              "error: no layer or channel 'alpha'; there are the channels 'R' and 'G'");
    EXPECT_EQ(pick_fault("Y", "alpha"), "error: no layer or channel 'alpha'; there is the channel 'Y'");
    EXPECT_EQ(
        pick_fault("R a.X", "alpha"),
        "error: no layer or channel 'alpha'; there is the layer 'a' and, without a layer, the channel 'R'");
    EXPECT_EQ(pick_fault("", "alpha"), "error: no layer or channel 'alpha'; there are no channels");
    EXPECT_EQ(pick_fault("R", ""),
              "error: no layer or channel is named after the ':'; there is the channel 'R'");
    EXPECT_EQ(pick_fault("a.R", "."), "error: no channel is without a layer; there is the layer 'a'");
    EXPECT_EQ(pick_fault("view.a.R", "veiw.R."),
              "error: no layer below 'veiw.R.'; there is the layer 'view.a'");
    EXPECT_EQ(pick_fault("view.a.R", "vew."),
              "error: no layer below 'vew.'; there is the layer 'view.a'; did you mean 'view.'?");
    EXPECT_EQ(pick_fault("a.R", "a."), "error: no layer below 'a.'; there is the layer 'a'");
    EXPECT_EQ(pick_fault("a.R", "a.."), "error: no layer below 'a..'; there is the layer 'a'");
}

TEST(Select, ListsSeveralMatches) {
    EXPECT_EQ(pick_fault("left.N.X right.N.X", "N"),
              "error: 'N' could be the layers 'left.N' and 'right.N'; name one in full");
    EXPECT_EQ(pick_fault("a.Z b.Z c.Y", "Z"),
              "error: 'Z' could be the channels 'a.Z' and 'b.Z'; name one in full");
}

TEST(Select, ListsNoMoreThanOneCanRead) {
    std::string line;
    for (int i = 10; i < 23; ++i) line += fmt::format("c{} ", i);
    EXPECT_TRUE(pick_fault(line, "alpha").ends_with("'c20', 'c21' and 'c22'"));
    EXPECT_TRUE(pick_fault(line + "c23 c24", "alpha").ends_with("'c20', 'c21' and 3 more"))
        << pick_fault(line + "c23 c24", "alpha");
}

TEST(Colour, IsRgbAndPerhapsA) {
    EXPECT_EQ(find_colour(names("A B G R")), (ColourChannels{3, 2, 1, 0}));
    EXPECT_EQ(find_colour(names("B G R Z")), (ColourChannels{2, 1, 0, std::nullopt}));
    const auto colour_fault = [](const std::string& line) {
        return fault([&] { find_colour(names(line)); });
    };
    EXPECT_EQ(colour_fault(kRender),
              "error: there is no colour (R G B) outside of the layer 'ViewLayer.Combined'; take one, as in "
              "':ViewLayer.Combined'");
    EXPECT_EQ(
        colour_fault("a.R a.G a.B b.R b.G b.B c.r c.g c.b R G"),
        "error: there is no colour (R G B) outside of the layers 'a', 'b' and 'c'; take one, as in ':a'");
    EXPECT_EQ(colour_fault("u v w"),
              "error: there is no colour (R G B); there are the channels 'u', 'v' and 'w'");
}

TEST(Matte, IsTheOnlyChannelOrA) {
    EXPECT_EQ(find_matte(names("edge")), 0U);
    EXPECT_EQ(find_matte(names("R A")), 1U);
    EXPECT_EQ(
        fault([] { find_matte(names("X Y")); }),
        "error: there is no matte, which is the only channel or A; there are the channels 'X' and 'Y'; take "
        "one channel, as in ':X'");
    EXPECT_EQ(fault([] { find_matte(names("")); }),
              "error: there is no matte, which is the only channel or A; there are no channels");
}

TEST(NamedChannels, AreFoundInTheOrderWanted) {
    EXPECT_EQ(find_channels(names("dx dy magnitude"), names("magnitude dx")),
              (std::vector<std::size_t>{2, 0}));
    EXPECT_EQ(fault([] { find_channels(names("R"), names("Z")); }),
              "error: the channel 'Z' is missing; there is the channel 'R'");
    EXPECT_EQ(fault([] { find_channels(names("R dx"), names("dx dy magnitude")); }),
              "error: the channels 'dy' and 'magnitude' are missing; there are the channels 'R' and 'dx'");
}

TEST(RgbaOrder, PutsBareChannelsAndRgbaFirst) {
    const Names from = names("b.B b.A b.R A B G R Z a.X a.W b.G");
    Names out;
    for (const std::size_t i : rgba_order(from)) out.push_back(from[i]);
    EXPECT_EQ(out, names("R G B A Z b.R b.G b.B b.A a.X a.W"));
}

}  // namespace
}  // namespace keyline
