// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/color/color.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <string>
#include <thread>
#include <unistd.h>
#include <vector>

namespace keyline {
namespace {

using Rgb = std::array<float, 3>;
using Matrix = std::array<std::array<double, 3>, 3>;

// Bradford-adapted from D60 to D65, from the chromaticities of the ACES specifications.
constexpr Matrix kAp1ToRec709 = {{{1.7050509927, -0.6217921207, -0.0832588720},
                                  {-0.1302564175, 1.1408047366, -0.0105483191},
                                  {-0.0240033568, -0.1289689761, 1.1529723329}}};
constexpr Matrix kAp0ToRec709 = {{{2.5216861867, -1.1341309882, -0.3875551985},
                                  {-0.2764799142, 1.3727190877, -0.0962391734},
                                  {-0.0153780650, -0.1529753359, 1.1683534008}}};

Rgb converted(const ColorTransform& transform, Rgb c) {
    transform.apply(c.data(), &c[1], &c[2], nullptr, 1);
    return c;
}

double srgb_encoded(double x) { return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055; }

// Samples of every kind a render holds, the last ones not numbers.
std::vector<float> samples(std::size_t n, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<float> out(n);
    for (float& x : out) {
        const auto bits = random();
        x = std::ldexp(static_cast<float>(bits >> 8U) - 0x1p22F, -static_cast<int>(18 + bits % 16));
    }
    return out;
}

std::array<std::vector<float>, 4> picture(std::size_t n) {
    return {samples(n, 1), samples(n, 2), samples(n, 3), samples(n, 4)};
}

std::uint32_t bits(float x) { return std::bit_cast<std::uint32_t>(x); }

std::vector<std::pair<std::string, ColorTransform>> all_transforms() {
    const auto config = ColorConfig::builtin();
    return {{"decode", config->convert("sRGB - Texture", "scene_linear")},
            {"encode", config->convert("scene_linear", "sRGB - Texture")},
            {"matrix", config->convert("scene_linear", "ACEScg")},
            {"mixed", config->convert("sRGB - Texture", "ACES2065-1")},
            {"aces", config->display("scene_linear", "", "")},
            {"plain", config->display("ACEScg", "sRGB - Display", "Un-tone-mapped")}};
}

TEST(ColorTransform, TextureIsTheCurveOfSrgb) {
    const auto config = ColorConfig::builtin();
    const ColorTransform encode = config->convert("scene_linear", "sRGB - Texture");
    const ColorTransform decode = config->convert("sRGB - Texture", "Linear Rec.709 (sRGB)");
    for (int i = 0; i <= 400; ++i) {
        const float x = static_cast<float>(i) / 200;
        const auto expected = static_cast<float>(srgb_encoded(x));
        // The library joins the straight piece to the curve exactly, the standard to four digits.
        EXPECT_NEAR(converted(encode, {x, 0, 0})[0], expected, 2e-6) << x;
        EXPECT_NEAR(converted(decode, {0, expected, 0})[1], x, 4e-6) << x;
    }
}

TEST(ColorTransform, AcesSpacesAreTheirMatrices) {
    const auto config = ColorConfig::builtin();
    for (const auto& [space, m] :
         {std::pair{"ACEScg", kAp1ToRec709}, std::pair{"ACES2065-1", kAp0ToRec709}}) {
        const ColorTransform there = config->convert(space, "scene_linear");
        const ColorTransform back = config->convert("scene_linear", space);
        const Rgb in = {0.25F, 3.5F, -0.75F};
        const Rgb out = converted(there, in);
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_NEAR(out[i], m[i][0] * 0.25 + m[i][1] * 3.5 - m[i][2] * 0.75, 4e-6) << space;
        const Rgb again = converted(back, out);
        for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(again[i], in[i], 4e-6) << space;
    }
}

// Published values of the ACES 1.0 output transform for sRGB: mid-grey 0.18 lands on 0.356.
TEST(ColorTransform, TheDefaultViewIsAces) {
    const auto config = ColorConfig::builtin();
    const ColorTransform view = config->display("scene_linear", "", "");
    const Rgb black = converted(view, {0, 0, 0}), grey = converted(view, {0.18F, 0.18F, 0.18F}),
              white = converted(view, {1, 1, 1}), bright = converted(view, {100, 100, 100});
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(black[i], 0.0, 1e-3);
        EXPECT_NEAR(grey[i], 0.35595, 2e-4);
        EXPECT_NEAR(white[i], 0.8114, 2e-3);
        EXPECT_NEAR(bright[i], 1.0, 0.03);  // the curve ends a little above the display's white
    }
    EXPECT_EQ(converted(config->display("scene_linear", "sRGB - Display", "ACES 1.0 - SDR Video"),
                        {0.3F, 0.1F, 0.7F}),
              converted(view, {0.3F, 0.1F, 0.7F}));
}

TEST(ColorTransform, UnToneMappedIsTheCurveAlone) {
    const ColorTransform view = ColorConfig::builtin()->display("scene_linear", "", "Un-tone-mapped");
    const Rgb out = converted(view, {0.18F, 0.5F, 4.0F});
    EXPECT_NEAR(out[0], srgb_encoded(0.18), 1e-5);
    EXPECT_NEAR(out[1], srgb_encoded(0.5), 1e-5);
    EXPECT_NEAR(out[2], srgb_encoded(4.0), 2e-5);
}

TEST(ColorTransform, DataAndEqualSpacesAreUntouched) {
    const auto config = ColorConfig::builtin();
    EXPECT_TRUE(ColorTransform().identity());
    EXPECT_TRUE(config->convert("ACEScg", "acescg").identity());
    EXPECT_TRUE(config->convert("scene_linear", "Linear Rec.709 (sRGB)").identity());
    EXPECT_TRUE(config->convert("Raw", "ACEScg").identity());
    EXPECT_TRUE(config->convert("sRGB - Texture", "data").identity());
    EXPECT_TRUE(config->display("scene_linear", "", "Raw").identity());
    EXPECT_FALSE(config->convert("ACEScg", "ACES2065-1").identity());
    float r = 0.1F, g = std::numeric_limits<float>::signaling_NaN(), b = -0.0F;
    const std::uint32_t before = bits(g);
    const float a = 0.3F;
    config->convert("Raw", "ACEScg").apply_premultiplied(&r, &g, &b, &a, 1);
    EXPECT_EQ(r, 0.1F);
    EXPECT_EQ(bits(g), before);
    EXPECT_TRUE(std::signbit(b));
}

// Rows of any length at any address give each pixel the bits it has alone.
TEST(ColorTransform, APixelDoesNotDependOnItsPlaceInARow) {
    constexpr std::size_t kPixels = 700;
    const auto [r, g, b, a] = picture(kPixels);
    for (const auto& [name, transform] : all_transforms()) {
        auto alone = std::array{r, g, b};
        for (std::size_t i = 0; i < kPixels; ++i)
            transform.apply_premultiplied(&alone[0][i], &alone[1][i], &alone[2][i], &a[i], 1);
        for (const std::size_t start : {0U, 1U, 2U, 3U, 5U, 8U, 13U, 255U})
            for (const std::size_t n : {2U, 3U, 4U, 7U, 31U, 255U, 256U, 257U, 445U}) {
                auto row = std::array{r, g, b};
                transform.apply_premultiplied(&row[0][start], &row[1][start], &row[2][start], &a[start], n);
                for (std::size_t c = 0; c < 3; ++c)
                    for (std::size_t i = 0; i < kPixels; ++i) {
                        const float expected =
                            i >= start && i < start + n ? alone[c][i] : std::array{&r, &g, &b}[c]->at(i);
                        ASSERT_EQ(bits(row[c][i]), bits(expected))
                            << name << ' ' << start << '+' << n << ' ' << i;
                    }
            }
    }
}

TEST(ColorTransform, IsTheSameFromEveryThread) {
    constexpr std::size_t kPixels = 5000;
    const auto in = picture(kPixels);
    const ColorTransform view = ColorConfig::builtin()->display("scene_linear", "", "");
    std::array<std::array<std::vector<float>, 3>, 4> results;
    {
        std::vector<std::jthread> threads;
        for (auto& result : results)
            threads.emplace_back([&, mine = view] {
                result = {in[0], in[1], in[2]};
                mine.apply(result[0].data(), result[1].data(), result[2].data(), in[3].data(), kPixels);
            });
    }
    for (std::size_t t = 1; t < results.size(); ++t) EXPECT_EQ(results[t], results[0]);
}

TEST(ColorTransform, PremultipliedColourIsDividedWhereAlphaIsPositive) {
    const ColorTransform encode = ColorConfig::builtin()->convert("scene_linear", "sRGB - Texture");
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::array<float, 6> a = {0.5F, 1.0F, 0.0F, -0.5F, nan, 2.0F};
    std::array<float, 6> r = {0.1F, 0.1F, 0.1F, 0.1F, 0.1F, 0.1F}, g = r, b = r;
    encode.apply_premultiplied(r.data(), g.data(), b.data(), a.data(), a.size());
    const float plain = converted(encode, {0.1F, 0.1F, 0.1F})[0];
    EXPECT_EQ(r[0], converted(encode, {0.2F, 0.2F, 0.2F})[0] * 0.5F);
    EXPECT_EQ(r[1], plain);
    EXPECT_EQ(r[2], plain);
    EXPECT_EQ(r[3], plain);
    EXPECT_EQ(r[4], plain);
    EXPECT_EQ(r[5], converted(encode, {0.05F, 0.05F, 0.05F})[0] * 2.0F);
    float one = 0.1F, two = 0.1F, three = 0.1F;
    encode.apply_premultiplied(&one, &two, &three, nullptr, 1);
    EXPECT_EQ(one, plain);
}

// A table of 2³ entries that swaps red and blue, found beside the config.
ColorTransform cube_transform() {
    const auto folder =
        std::filesystem::path(::testing::TempDir()) / ("keyline_cube_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
    std::ofstream cube(folder / "swap.cube");
    cube << "LUT_3D_SIZE 2\n";
    for (int blue = 0; blue < 2; ++blue)
        for (int green = 0; green < 2; ++green)
            for (int red = 0; red < 2; ++red) cube << blue << ' ' << green << ' ' << red << '\n';
    cube.close();
    std::ofstream(folder / "c.ocio") << "ocio_profile_version: 2\nroles: {default: lin}\ncolorspaces:\n"
                                        "  - !<ColorSpace> {name: lin}\n"
                                        "  - !<ColorSpace>\n    name: swapped\n"
                                        "    from_scene_reference: !<FileTransform> {src: swap.cube}\n";
    ColorTransform transform = ColorConfig::load(folder / "c.ocio")->convert("lin", "swapped");
    std::filesystem::remove_all(folder);
    return transform;
}

TEST(ColorTransform, TablesAreFoundBesideTheConfig) {
    EXPECT_EQ(converted(cube_transform(), {0.25F, 0.5F, 0.75F}), (Rgb{0.75F, 0.5F, 0.25F}));
}

TEST(ColorTransform, TakesSamplesThatAreNoNumbers) {
    auto transforms = all_transforms();
    transforms.emplace_back("cube", cube_transform());
    const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    const std::array values = {nan, inf, -inf, -0.0F, 1e-40F, 3e38F, -3e38F};
    for (const auto& [name, transform] : transforms)
        for (const float x : values)
            for (const float y : values) {
                std::array<float, 3> r = {x, 0.5F, y}, g = {y, 0.5F, x}, b = {x, 0.5F, x}, a = {y, 1.0F, x};
                transform.apply_premultiplied(r.data(), g.data(), b.data(), a.data(), 3);
                EXPECT_EQ(bits(r[1]), bits(converted(transform, {0.5F, 0.5F, 0.5F})[0])) << name;
            }
}

}  // namespace
}  // namespace keyline
