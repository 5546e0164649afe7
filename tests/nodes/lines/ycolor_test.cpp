// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/run.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gmock/gmock.h>

namespace keyline::testing {
namespace {

using Weights = std::array<double, 3>;

Image grey(const Image& in, const Weights& w, bool clamp = false, double gamma = 1) {
    Image out(in.window, {"Y"});
    out.display = in.display;
    return out.fill("Y", [&](int x, int y) {
        double v = w[0] * static_cast<double>(in.at("R", x, y)) +
                   w[1] * static_cast<double>(in.at("G", x, y)) +
                   w[2] * static_cast<double>(in.at("B", x, y));
        if (clamp) v = std::clamp(v, 0.0, 1.0);
        return gamma == 1 ? v : std::copysign(std::pow(std::abs(v), 1 / gamma), v);
    });
}

Image pixel(float r, float g, float b) {
    Image image({0, 0, 1, 1}, {"R", "G", "B"});
    image.at("R", 0, 0) = r, image.at("G", 0, 0) = g, image.at("B", 0, 0) = b;
    return image;
}

TEST(YColor, WeighsAsTheWordsSay) {
    const Image in = noise({-5, 2, 60, 31}, {"R", "G", "B", "A"}, 1, -1, 4);
    const std::pair<const char*, Weights> words[] = {{"ntsc", {0.299, 0.587, 0.114}},
                                                     {"rec709", {0.2126, 0.7152, 0.0722}},
                                                     {"acescg", {0.2722287, 0.6740818, 0.0536895}}};
    for (const auto& [word, weights] : words)
        EXPECT_IMAGE_AGREES(run("ycolor", {{"weights", word}}, in), grey(in, weights), in, 0);
    EXPECT_IMAGE(run("ycolor", {}, in), run("ycolor", {{"weights", "ntsc"}}, in));
    EXPECT_IMAGE_AGREES(run("ycolor", {{"weights", {1, -2, 0.5}}}, in), grey(in, {1, -2, 0.5}), in, 0);
}

TEST(YColor, AgreesOnARealPlate) {
    const Image in = plate();
    EXPECT_IMAGE_AGREES(run("ycolor", {}, in), grey(in, {0.299, 0.587, 0.114}), in, 0);
    EXPECT_IMAGE_NEAR(run("ycolor", {{"gamma", 2.2}, {"clamp", true}}, in),
                      grey(in, {0.299, 0.587, 0.114}, true, 2.2), 1e-5);
}

TEST(YColor, ClampsBeforeGammaAndKeepsTheSignWithoutIt) {
    EXPECT_NEAR(run("ycolor", {{"gamma", 2}}, pixel(-4, -4, -4)).at("Y", 0, 0), -2, 1e-6);
    EXPECT_EQ(run("ycolor", {{"gamma", 2}, {"clamp", true}}, pixel(-4, -4, -4)).at("Y", 0, 0), 0);
    EXPECT_EQ(run("ycolor", {{"gamma", 2}, {"clamp", true}}, pixel(9, 9, 9)).at("Y", 0, 0), 1);
    EXPECT_EQ(run("ycolor", {{"gamma", 0.5}}, pixel(0, 0, 0)).at("Y", 0, 0), 0);
}

TEST(YColor, OfPremultipliedColourIsNotDividedByAlpha) {
    Image in({0, 0, 1, 1}, {"R", "G", "B", "A"});
    for (const char* c : {"R", "G", "B", "A"}) in.at(c, 0, 0) = 0.25F;
    EXPECT_FLOAT_EQ(run("ycolor", {}, in).at("Y", 0, 0), 0.25F);
}

TEST(YColor, MakesYAndNothingElse) { EXPECT_EQ(run("ycolor", {}, plate()).channels.size(), 1U); }

TEST(YColor, ANanStaysOne) {
    for (const bool clamp : {false, true})
        EXPECT_TRUE(std::isnan(
            run("ycolor", {{"clamp", clamp}, {"gamma", 2.2}}, pixel(std::nanf(""), 0, 1)).at("Y", 0, 0)));
}

TEST(YColor, NeedsColour) {
    EXPECT_THAT(error_of("ycolor", {}, Image({0, 0, 1, 1}, {"diffuse.R", "diffuse.G", "diffuse.B"})),
                ::testing::HasSubstr("diffuse"));
    EXPECT_THAT(error_of("ycolor", {{"weights", "rec601"}}, pixel(0, 0, 0)), ::testing::HasSubstr("rec601"));
    EXPECT_THAT(error_of("ycolor", {{"gamma", 0}}, pixel(0, 0, 0)), ::testing::HasSubstr("'gamma' is 0"));
}

}  // namespace
}  // namespace keyline::testing
