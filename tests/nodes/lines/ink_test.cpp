// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/run.h"

#include <bit>
#include <cmath>
#include <gmock/gmock.h>
#include <limits>

namespace keyline::testing {
namespace {

TEST(Ink, IsPremultipliedColourWhereTheMatteIs) {
    const Image matte = ascii({".1", "2."});
    const Image out = run("ink", {{"color", {0.5, 0.25, 2}}, {"opacity", 0.5}}, matte);
    EXPECT_EQ(out.channel("A").samples, (std::vector<float>{0, 0.5F, 1, 0}));
    EXPECT_EQ(out.channel("R").samples, (std::vector<float>{0, 0.25F, 0.5F, 0}));
    EXPECT_EQ(out.channel("G").samples, (std::vector<float>{0, 0.125F, 0.25F, 0}));
    EXPECT_EQ(out.channel("B").samples, (std::vector<float>{0, 1, 2, 0}));
}

TEST(Ink, IsBlackAndOpaqueByDefault) {
    const Image out = run("ink", {}, ascii({"1"}));
    EXPECT_EQ(out.at("R", 0, 0), 0);
    EXPECT_EQ(out.at("A", 0, 0), 1);
}

TEST(Ink, IsTintedByAnImage) {
    const Image albedo = Image({0, 0, 2, 1}, {"R", "G", "B"}).fill("R", [](int x, int) { return 1.0 + x; });
    const Image out = run("ink", {{"color", {0.5, 0.5, 0.5}}},
                          std::map<std::string, Image>{{"in", ascii({"12"})}, {"tint", albedo}});
    EXPECT_EQ(out.channel("R").samples, (std::vector<float>{0.5F, 2}));
    EXPECT_EQ(out.channel("G").samples, (std::vector<float>{0, 0}));
    EXPECT_EQ(out.channel("A").samples, (std::vector<float>{1, 2}));
}

TEST(Ink, AColourInHexIsSrgb) {
    const Image out = run("ink", {{"color", "#ff8000"}}, ascii({"1"}));
    EXPECT_FLOAT_EQ(out.at("R", 0, 0), 1);
    EXPECT_NEAR(out.at("G", 0, 0), std::pow((128 / 255.0 + 0.055) / 1.055, 2.4), 1e-7);
    EXPECT_EQ(out.at("B", 0, 0), 0);
}

TEST(Ink, TakesTheOnlyChannelOrAlpha) {
    Image rgba({0, 0, 1, 1}, {"R", "G", "B", "A"});
    rgba.at("A", 0, 0) = 0.75F;
    EXPECT_EQ(run("ink", {}, rgba).at("A", 0, 0), 0.75F);
    EXPECT_NE(error_of("ink", {}, Image({0, 0, 1, 1}, {"X", "Y"})), "");
}

// Of two NaNs arithmetic keeps one, and which the compiler decides.
TEST(Ink, HasOneNan) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    const Image matte = Image({0, 0, 19, 1}, {"Y"}).fill("Y", [](int, int) { return -kNan; });
    const Image albedo = Image({0, 0, 19, 1}, {"R", "G", "B"}).fill("R", [](int, int) { return kNan; });
    const Image out =
        run("ink", {{"color", {1, 1, 1}}}, std::map<std::string, Image>{{"in", matte}, {"tint", albedo}});
    for (const Image::Channel& c : out.channels)
        for (const float v : c.samples)
            EXPECT_EQ(std::bit_cast<uint32_t>(v), std::bit_cast<uint32_t>(kNan)) << c.name;
}

TEST(Ink, RefusesMoreThanOpaque) {
    EXPECT_THAT(error_of("ink", {{"opacity", 1.5}}, ascii({"1"})), ::testing::HasSubstr("from 0 to 1"));
    EXPECT_THAT(error_of("ink", {{"color", "#ff80"}}, ascii({"1"})), ::testing::HasSubstr("#ff80"));
}

}  // namespace
}  // namespace keyline::testing
