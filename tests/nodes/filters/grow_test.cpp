// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/run.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace keyline::testing {
namespace {

float clamped(double d) { return static_cast<float>(std::clamp(d, 0.0, 1.0)); }

// A disc with soft edges, as coverage is within a hundredth or two.
Image disc(const Rect& window, double x, double y, double radius) {
    Image image(window, {"A"});
    image.fill(
        "A", [&](int px, int py) { return clamped(radius + 0.5 - std::hypot(px + 0.5 - x, py + 0.5 - y)); });
    return image;
}

double sum(const Image& image) {
    double out = 0;
    for (const float a : image.channel("A").samples) out += a;
    return out;
}

TEST(Grow, MovesASoftEdgeByItsRadius) {
    Image half({0, 0, 20, 3}, {"A"});
    half.fill("A", [](int x, int) { return clamped(7.25 - x); });  // an edge at 7.25
    for (const double radius : {0.0, 0.5, 1.0, 2.75, 6.0}) {
        const Image image = run("grow", {{"radius", radius}}, half);
        for (int x = 0; x < 20; ++x)
            EXPECT_NEAR(image.at("A", x, 1), clamped(7.25 + radius - x), 1e-5) << radius;
    }
}

TEST(Grow, MakesADiscALargerDisc) {
    const Rect window{0, 0, 40, 40};
    const Image small = disc(window, 20.3, 19.6, 5);
    for (const double radius : {1.0, 2.5, 6.0}) {
        const Image image = run("grow", {{"radius", radius}}, small),
                    expected = disc(window, 20.3, 19.6, 5 + radius);
        for (int y = 0; y < 40; ++y)
            for (int x = 0; x < 40; ++x)
                EXPECT_NEAR(image.at("A", x, y), expected.at("A", x, y), 0.12) << radius;
        EXPECT_NEAR(sum(image), M_PI * (5 + radius) * (5 + radius), 0.02 * sum(expected)) << radius;
    }
}

TEST(Grow, ReachesNoFartherThanItsDistance) {
    Image dot({-8, -8, 9, 9}, {"A"});
    dot.at("A", 0, 0) = 1;
    const Image image = run("grow", {{"radius", 3.5}}, dot);
    for (int y = -8; y < 9; ++y)
        for (int x = -8; x < 9; ++x)
            EXPECT_NEAR(image.at("A", x, y), clamped(4.5 - std::hypot(x, y)), 0.15) << x << ' ' << y;
    EXPECT_EQ(image.at("A", 5, 0), 0);
    EXPECT_EQ(image.at("A", -4, 0), 0.5F);
}

TEST(Grow, KeepsHairsThatCoverNoPixelHalf) {
    Image hair({0, 0, 9, 3}, {"A"});
    for (int y = 0; y < 3; ++y) hair.at("A", 4, y) = 0.25F;
    const Image image = run("grow", {{"radius", 1}}, hair);
    EXPECT_EQ(image.at("A", 4, 1), 1);
    EXPECT_EQ(image.at("A", 5, 1), 0.25F);
    EXPECT_EQ(image.at("A", 6, 1), 0);
}

TEST(Grow, ByNothingChangesNothing) {
    const Image small = disc({0, 0, 20, 20}, 9.3, 8.6, 5);
    EXPECT_IMAGE(run("grow", {{"radius", 0}}, small), small);
}

TEST(Grow, TakesWhatIsNoMaskAsTheNearestThatIs) {
    Image odd({0, 0, 9, 1}, {"A"});
    odd.at("A", 1, 0) = -3;
    odd.at("A", 4, 0) = 7;
    odd.at("A", 8, 0) = std::nanf("");
    const Image image = run("grow", {{"radius", 1}}, odd);
    const std::vector<float> expected{0, 0, 0, 1, 1, 1, 0, 0, 0};
    EXPECT_EQ(image.channel("A").samples, expected);
}

}  // namespace
}  // namespace keyline::testing
