// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/run.h"

// What the groups that come with Keyline make of pictures that are known.

namespace keyline::testing {
namespace {

// The group's result of images by the names of its inputs.
Image made(const std::string& group, Json use, const std::map<std::string, Image>& inputs) {
    use.set("type", group);
    std::map<std::string, Image> named;
    for (const auto& [input, image] : inputs) {
        use.set(input, "of_" + input);
        named["of_" + input] = image;
    }
    return run_graph(Json{{"made", use}}, "made", named);
}

Image flat(const Rect& window, const std::vector<std::string>& channels, double value) {
    Image image(window, channels);
    for (const std::string& c : channels) image.fill(c, [&](int, int) { return value; });
    return image;
}

TEST(Despeckle, TakesSpecksAndLeavesEdges) {
    const Image picture = ascii({"22222255555", "22922255555", "22222255055", "22222255555", "22222255555"});
    const Image clean = ascii({"22222255555", "22222255555", "22222255555", "22222255555", "22222255555"});
    EXPECT_IMAGE(only(made("despeckle", Json{{"radius", 1}, {"shape", "square"}}, {{"in", picture}}), {"Y"}),
                 clean);
    EXPECT_IMAGE(made("despeckle", Json{{"radius", 0}}, {{"in", picture}}), picture);
}

TEST(CastShadowMatte, HasNoIslandsAndKeepsItsEdge) {
    Image light({0, 0, 12, 9}, {"R", "G", "B"});
    for (const char* c : {"R", "G", "B"})
        light.fill(c, [](int x, int y) {
            const bool is_noise = (x == 2 && y == 4) || (x == 9 && y == 4);
            return (x < 6) != is_noise ? 1 : 0;
        });
    const Image lit = made("cast_shadow_matte", Json{{"island", 1}}, {{"light", light}});
    for (int y = 2; y < 7; ++y)
        for (int x = 2; x < 10; ++x) EXPECT_EQ(lit.at("Y", x, y), x < 6 ? 1 : 0) << x << ' ' << y;
}

TEST(IdLines, StandBetweenIdsAndGrow) {
    const Image ids = ascii({"1112222", "1112222", "1112222"}, "id");
    EXPECT_IMAGE(made("id_lines", Json{{"layer", ""}}, {{"ids", ids}}),
                 ascii({"..11...", "..11...", "..11..."}, "edge"));
    EXPECT_IMAGE(made("id_lines", Json{{"layer", ""}, {"bolder", 1}}, {{"ids", ids}}),
                 ascii({".1111..", ".1111..", ".1111.."}, "edge"));
}

TEST(InkOver, LaysInkWhereLinesAre) {
    const Image lines = ascii({".....", "..1..", "....."});
    const Image picture = flat({0, 0, 5, 3}, {"R", "G", "B", "A"}, 1);
    const Image inked = made("ink_over", Json{{"color", {0.25, 0, 0}}, {"bolder", 1}},
                             {{"lines", lines}, {"picture", picture}});
    EXPECT_EQ(inked.at("R", 2, 0), 0.25F);
    EXPECT_EQ(inked.at("G", 2, 1), 0);
    EXPECT_EQ(inked.at("R", 1, 0), 1);
    EXPECT_EQ(inked.at("A", 2, 1), 1);
}

TEST(FlatTones, AreTheColoursInLightAndInShade) {
    const Image albedo = flat({0, 0, 2, 1}, {"R", "G", "B"}, 0.5);
    const Image tones =
        made("flat_tones", Json{{"light", {1, 1, 0.5}}, {"shade", {0.5, 0.25, 0}}, {"lift", 0.125}},
             {{"albedo", albedo}, {"lit", ascii({"1."})}});
    EXPECT_EQ(tones.at("R", 0, 0), 0.5F);
    EXPECT_EQ(tones.at("B", 0, 0), 0.25F);
    EXPECT_EQ(tones.at("R", 1, 0), 0.375F);
    EXPECT_EQ(tones.at("G", 1, 0), 0.25F);
    EXPECT_EQ(tones.at("B", 1, 0), 0.125F);
}

// A wall far away, a box before it, and nothing at all on the right.
TEST(RimLight, IsOnTheSideOfTheLightAndNotAtThePicturesEdge) {
    const Image depth = Image({0, 0, 12, 4}, {"Z"}).fill("Z", [](int x, int y) {
        return x > 9 ? 0 : x >= 4 && x < 8 && y > 1 ? 5 : 10;
    });
    const auto expect_rim = [&](const Json& light, const Image& wanted) {
        const Image rim = made("rim_light", light, {{"depth", depth}});
        for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 12; ++x) EXPECT_EQ(rim.at("Z", x, y), wanted.at("Y", x, y)) << x << ' ' << y;
    };
    expect_rim(Json{{"right", 2}, {"up", 0}},
               ascii({"........11..", "........11..", "......1111..", "......1111.."}));
    expect_rim(Json{{"right", 0}, {"up", 1}},
               ascii({"............", "............", "....1111....", "............"}));
}

}  // namespace
}  // namespace keyline::testing
