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

// fg k + bg (1 - fg.A k) with k = mix × mask, every input 0 outside its window.
TEST(Over, AgreesWithTheDefinitionWhereverTheWindowsLie) {
    const Rect windows[] = {{0, 0, 40, 30}, {-20, -5, 12, 44}, {35, 25, 60, 26}, {100, 100, 110, 103}};
    const Image bg = noise(windows[0], {"R", "G", "B", "A"}, 1, -1, 3);
    for (const Rect& fg_window : windows)
        for (const Rect& mask_window : windows) {
            const Image fg = noise(fg_window, {"R", "G", "B", "A"}, 2, 0, 1),
                        mask = noise(mask_window, {"Y"}, 3);
            Image expected(unite(fg_window, bg.window), {"R", "G", "B", "A"});
            expected.display = bg.display;
            for (const char* c : {"R", "G", "B", "A"})
                expected.fill(c, [&](int x, int y) {
                    const double k = 0.75 * static_cast<double>(mask.at("Y", x, y));
                    return static_cast<double>(fg.at(c, x, y)) * k +
                           static_cast<double>(bg.at(c, x, y)) *
                               (1 - static_cast<double>(fg.at("A", x, y)) * k);
                });
            EXPECT_IMAGE_NEAR(
                run("over", {{"mix", 0.75}}, {{"fg", fg}, {"bg", bg}, {"mask", mask}}, {.tile = 16}),
                expected, 3e-6);
        }
}

TEST(Over, TakesWindowAndMetadataFromTheBackground) {
    Image fg = rgba({0, 0, 2, 2}, 1, 1, 1, 1), bg = rgba({0, 0, 4, 4}, 0, 0, 0, 1);
    fg.display = {0, 0, 100, 100};
    fg.metadata.set({"artist", "string", std::string("fg")});
    bg.metadata.set({"artist", "string", std::string("bg")});
    const Image out = run("over", {}, {{"fg", fg}, {"bg", bg}});
    EXPECT_EQ(out.display, bg.display);
    EXPECT_EQ(std::get<std::string>(out.metadata.find("artist")->value), "bg");
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
