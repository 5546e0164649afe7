// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/run.h"

#include <cmath>
#include <gmock/gmock.h>

namespace keyline::testing {
namespace {

double srgb_decoded(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }

// sRGB's curve undone, with colour divided by A where A > 0, and as it is elsewhere.
Image decoded(const Image& in) {
    Image out = in;
    for (const char* c : {"R", "G", "B"})
        out.fill(c, [&](int x, int y) {
            const double v = in.at(c, x, y), a = in.has("A") ? static_cast<double>(in.at("A", x, y)) : 1;
            return a > 0 ? a * srgb_decoded(v / a) : srgb_decoded(v);
        });
    return out;
}

const Json kDecode{{"from", "sRGB - Texture"}, {"to", "scene_linear"}};

TEST(ColorspaceNode, ConvertsAMatrix) {
    const Image in = noise({2, 2, 40, 20}, {"R", "G", "B"}, 1, -1, 4);
    const double m[3][3] = {{0.61309740, 0.33952315, 0.04737945},
                            {0.07019372, 0.91635388, 0.01345240},
                            {0.02061559, 0.10956977, 0.86981463}};
    Image expected = in;
    for (std::size_t row = 0; row < 3; ++row)
        expected.fill(in.channels[row].name, [&](int x, int y) {
            return m[row][0] * static_cast<double>(in.at("R", x, y)) +
                   m[row][1] * static_cast<double>(in.at("G", x, y)) +
                   m[row][2] * static_cast<double>(in.at("B", x, y));
        });
    EXPECT_IMAGE_AGREES(run("colorspace", {{"to", "ACEScg"}}, in), expected, in, 0);
}

TEST(ColorspaceNode, UnpremultipliesAroundTheTransform) {
    const Image in = noise({0, 0, 50, 30}, {"R", "G", "B", "A"}, 2, 0.05F, 0.5F);
    EXPECT_IMAGE_NEAR(run("colorspace", kDecode, in), decoded(in), 1e-5);
}

TEST(ColorspaceNode, WhereAlphaIsNotPositiveColourIsTakenAsItIs) {
    Image in = noise({0, 0, 4, 1}, {"R", "G", "B", "A"}, 3, 0.2F, 0.6F);
    in.channel("A").samples = {0, -0.5F, 0.5F, -0.0F};
    EXPECT_IMAGE_NEAR(run("colorspace", kDecode, in), decoded(in), 1e-5);
}

TEST(ColorspaceNode, OtherChannelsPassAndChromaticitiesGo) {
    Image in = noise({0, 0, 8, 8}, {"R", "G", "B", "A", "depth.Z"}, 4, 0.1F, 1);
    in.metadata.set({"chromaticities", "chromaticities", std::vector<float>(8, 0.3F)});
    in.metadata.set({"ICCProfile", "bytes", std::vector<std::byte>(9)});
    in.metadata.set({"artist", "string", std::string("me")});
    const Image out = run("colorspace", kDecode, in);
    EXPECT_IMAGE(only(out, {"A", "depth.Z"}), only(in, {"A", "depth.Z"}));
    EXPECT_EQ(out.metadata.find("chromaticities"), nullptr);
    EXPECT_EQ(out.metadata.find("ICCProfile"), nullptr);
    EXPECT_NE(out.metadata.find("artist"), nullptr);
}

TEST(ColorspaceNode, BetweenEqualSpacesNothingChanges) {
    Image in = noise({0, 0, 8, 8}, {"R", "G", "B", "A"}, 4, 0.1F, 1);
    in.metadata.set({"chromaticities", "chromaticities", std::vector<float>(8, 0.3F)});
    in.metadata.set({"ICCProfile", "bytes", std::vector<std::byte>(9)});
    const Image out = run("colorspace", {{"to", "scene_linear"}}, in);
    EXPECT_IMAGE(out, in);
    EXPECT_NE(out.metadata.find("chromaticities"), nullptr);
    EXPECT_NE(out.metadata.find("ICCProfile"), nullptr);
}

TEST(ColorspaceNode, SaysWhichSpacesThereAre) {
    const std::string text =
        error_of("colorspace", {{"to", "ACEScgg"}}, noise({0, 0, 1, 1}, {"R", "G", "B"}, 1));
    EXPECT_THAT(text, ::testing::HasSubstr("node 'node' (colorspace)"));
    EXPECT_THAT(text, ::testing::HasSubstr("ACEScg"));
}

}  // namespace
}  // namespace keyline::testing
