// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/run.h"

namespace keyline::testing {
namespace {

Image rgba(const Rect& window, float r, float g, float b, float a) {
    Image image(window, {"R", "G", "B", "A"});
    const float value[] = {r, g, b, a};
    for (std::size_t c = 0; c < 4; ++c)
        image.fill(image.channels[c].name, [&](int, int) { return value[c]; });
    return image;
}

TEST(Over, LaysPremultipliedColourOverAnother) {
    const Rect w{0, 0, 2, 2};
    EXPECT_IMAGE_NEAR(
        run("over", {}, {{"fg", rgba(w, 0.2F, 0.1F, 0, 0.5F)}, {"bg", rgba(w, 1, 0.5F, 0.25F, 1)}}),
        rgba(w, 0.7F, 0.35F, 0.125F, 1), 1e-6);
}

TEST(Over, CoversTheUnionAndIsNothingOutsideAnInput) {
    const Image fg = rgba({-2, 0, 1, 1}, 0.5F, 0.5F, 0.5F, 0.5F), bg = rgba({0, 0, 2, 2}, 1, 1, 1, 1);
    const Image out = run("over", {}, {{"fg", fg}, {"bg", bg}});
    EXPECT_EQ(out.window, (Rect{-2, 0, 2, 2}));
    EXPECT_EQ(out.display, bg.display);
    EXPECT_EQ(out.at("R", -2, 0), 0.5F);
    EXPECT_EQ(out.at("A", -2, 0), 0.5F);
    EXPECT_EQ(out.at("R", -1, 1), 0.0F);
    EXPECT_EQ(out.at("R", 0, 0), 1.0F);
    EXPECT_EQ(out.at("A", 1, 1), 1.0F);
}

TEST(Over, AnInputWithoutAlphaIsOpaqueInsideItsWindow) {
    Image fg({0, 0, 1, 1}, {"R", "G", "B"});
    fg.at("R", 0, 0) = 0.25F;
    const Image out = run("over", {}, {{"fg", fg}, {"bg", rgba({0, 0, 2, 1}, 1, 1, 1, 1)}});
    EXPECT_EQ(out.at("R", 0, 0), 0.25F);
    EXPECT_EQ(out.at("R", 1, 0), 1.0F);
}

TEST(Over, MixAndMaskScaleTheForeground) {
    const Rect w{0, 0, 1, 1};
    Image mask(w, {"Y"});
    mask.at("Y", 0, 0) = 0.5F;
    const Image out = run("over", {{"mix", 0.5}},
                          {{"fg", rgba(w, 1, 1, 1, 1)}, {"bg", rgba(w, 0, 0, 0, 1)}, {"mask", mask}});
    EXPECT_IMAGE_NEAR(out, rgba(w, 0.25F, 0.25F, 0.25F, 1), 1e-7);
}

TEST(Over, OtherChannelsOfTheBackgroundPass) {
    Image bg = rgba({0, 0, 3, 1}, 1, 1, 1, 1);
    bg.channels.push_back({"depth.Z", SampleType::kFloat, {7, 8, 9}});
    const Image out = run("over", {}, {{"fg", rgba({-1, 0, 1, 1}, 0, 0, 0, 1)}, {"bg", bg}});
    EXPECT_EQ(out.at("depth.Z", 2, 0), 9);
    EXPECT_EQ(out.at("depth.Z", -1, 0), 0);
}

}  // namespace
}  // namespace keyline::testing
