// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/run.h"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>

namespace keyline::testing {
namespace {

double srgb_encoded(double v) { return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055; }

TEST(Display, WithoutToneMappingIsTheDisplaysCurve) {
    const Image in = noise({-4, 1, 40, 20}, {"R", "G", "B"}, 1, 0, 1);
    Image expected = in;
    for (const char* c : {"R", "G", "B"})
        expected.fill(c, [&](int x, int y) { return srgb_encoded(in.at(c, x, y)); });
    EXPECT_IMAGE_NEAR(run("display", {{"view", "Un-tone-mapped"}}, in), expected, 1e-5);
}

TEST(Display, OfARealPlateUnpremultipliesWhereThereIsAlpha) {
    const Image in = cropped(plate(), {0, 0, 240, 135});
    Image expected = in;
    for (const char* c : {"R", "G", "B"})
        expected.fill(c, [&](int x, int y) {
            const double a = in.at("A", x, y), v = in.at(c, x, y);
            return a > 0 ? a * srgb_encoded(v / a) : srgb_encoded(v);
        });
    EXPECT_IMAGE_NEAR(run("display", {{"view", "Un-tone-mapped"}}, in), expected, 3e-5);
}

TEST(Display, TheDefaultViewCompressesWhatIsBright) {
    Image in({0, 0, 3, 1}, {"R", "G", "B"});
    for (Image::Channel& c : in.channels) c.samples = {0, 0.18F, 16};
    const Image out = run("display", {}, in);
    EXPECT_NEAR(out.at("G", 0, 0), 0, 1e-3);
    EXPECT_GT(out.at("G", 1, 0), 0.3F);
    EXPECT_LT(out.at("G", 1, 0), 0.5F);
    EXPECT_GT(out.at("G", 2, 0), 0.9F);
    EXPECT_LT(out.at("G", 2, 0), 1.05F);
}

TEST(Display, OtherChannelsPassAndChromaticitiesGo) {
    Image in = noise({0, 0, 8, 8}, {"R", "G", "B", "A", "depth.Z"}, 4, 0.1F, 1);
    in.metadata.set({"chromaticities", "chromaticities", std::vector<float>(8, 0.3F)});
    const Image out = run("display", {}, in);
    EXPECT_IMAGE(only(out, {"A", "depth.Z"}), only(in, {"A", "depth.Z"}));
    EXPECT_EQ(out.metadata.find("chromaticities"), nullptr);
}

TEST(Display, SaysWhichViewsAndDisplaysThereAre) {
    const Image in = noise({0, 0, 1, 1}, {"R", "G", "B"}, 1);
    EXPECT_THAT(error_of("display", {{"view", "Untonemapped"}}, in), ::testing::HasSubstr("Un-tone-mapped"));
    EXPECT_THAT(error_of("display", {{"display", "P3"}}, in), ::testing::HasSubstr("sRGB"));
}

}  // namespace
}  // namespace keyline::testing
