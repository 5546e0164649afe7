// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/scene.h"

#include "engine/kit/cryptomatte.h"

#include <bit>
#include <cmath>
#include <gmock/gmock.h>
#include <numbers>

// The truth that strokes are measured against is itself true.

namespace keyline::testing {
namespace {

constexpr Vec3 kBall{0.5, 0.4, 6};
constexpr double kRadius = 1, kGround = 1;

Scene ball_in_the_ground() {
    const Camera camera;
    return {.things = {ground("ground", camera, kGround), sphere("ball", camera, kBall, kRadius)},
            .contacts = {contact(camera, kBall, kRadius, kGround)}};
}

// How much of the picture a thing covers, in pixels.
double area_of(const Image& passes, const std::string& name) {
    const float id = std::bit_cast<float>(cryptomatte_id(name));
    double sum = 0;
    for (const std::string layer : {"CryptoObject00.", "CryptoObject01."})
        for (const auto& [i, c] : {std::pair{"r", "g"}, std::pair{"b", "a"}}) {
            const auto& ids = passes.channel(layer + i).samples;
            const auto& covered = passes.channel(layer + c).samples;
            for (std::size_t k = 0; k < ids.size(); ++k)
                if (ids[k] == id) sum += covered[k];
        }
    return sum;
}

TEST(Scene, CoverageIsTheAreaThatAThingHas) {
    const Scene scene{.things = {disc("a", {20.3, 21.7}, 12, 5), disc("b", {24.3, 21.7}, 3, 2)}};
    const double small = 9 * std::numbers::pi, large = 144 * std::numbers::pi;
    EXPECT_NEAR(area_of(passes_of(scene), "b"), small, 0.02);
    EXPECT_NEAR(area_of(passes_of(scene), "a"), large - small, 0.05);
    EXPECT_NEAR(area_of(passes_of(scene, 64), "a"), large - small, 2);
}

TEST(Scene, CoverageOfAStraightEdgeIsLinear) {
    const Scene scene{.window = {0, 0, 4, 1},
                      .things = {polygon("a", {{-9, -9}, {1.3, -9}, {1.3, 9}, {-9, 9}}, 1)}};
    EXPECT_THAT(passes_of(scene).channel("CryptoObject00.g").samples,
                ::testing::Pointwise(::testing::FloatNear(0.02F), {1.0F, 0.3F, 0.0F, 0.0F}));
}

TEST(Scene, DepthNormalAndPositionAreThoseOfThePixelsCentre) {
    const Image passes = passes_of(ball_in_the_ground());
    const int x = 27, y = 26;  // on the ball
    const double px = passes.at("Position.X", x, y), py = passes.at("Position.Y", x, y),
                 pz = passes.at("Position.Z", x, y);
    EXPECT_NEAR(std::hypot(px - kBall.x, -py - kBall.y, -pz - kBall.z), kRadius, 1e-6);
    EXPECT_NEAR(24 + 48 * px / -pz, x + 0.5, 1e-5);
    EXPECT_NEAR(passes.at("Depth.Z", x, y), -pz, 1e-6);
    EXPECT_NEAR(passes.at("Normal.X", x, y), px - kBall.x, 1e-6);
    EXPECT_NEAR(passes.at("Normal.Y", x, y), py + kBall.y, 1e-6);
    EXPECT_EQ(passes.at("Normal.Y", 5, 45), 1);
    EXPECT_EQ(passes.at("Depth.Z", 5, 5), 1e10F);
}

TEST(Scene, LinesAreWhatIsSeen) {
    const Scene scene = ball_in_the_ground();
    double outline = 0, contact = 0, horizon = 0;
    for (const TruePoint& p : lines_of(scene)) {
        const Point inside{p.at.x - 0.01 * p.outward.x, p.at.y - 0.01 * p.outward.y};
        const Front front = front_of(scene, inside);
        ASSERT_TRUE(front.thing && front.thing->name == p.near) << p.at.x << ' ' << p.at.y;
        const bool touches = p.far_depth - p.near_depth < 0.01;
        if (touches) contact += p.length;
        if (p.near == "ball" && !touches) outline += p.length;
        if (p.near == "ground" && p.far.empty()) horizon += p.length;
    }
    EXPECT_GT(outline, 20);
    EXPECT_GT(contact, 5);
    EXPECT_GT(horizon, 30);
}

TEST(Scene, WhatIsHiddenHasNoLines) {
    const Scene scene{.things = {disc("behind", {20, 20}, 4, 5), disc("before", {20, 20}, 6, 2)}};
    for (const TruePoint& p : lines_of(scene)) ASSERT_EQ(p.near, "before");
}

TEST(Scene, OffsetsAreSigned) {
    const std::vector<TruePoint> lines = lines_of({.things = {disc("a", {20, 20}, 5, 1)}});
    EXPECT_NEAR(offset_from(lines, {25.3, 20}), 0.3, 1e-4);
    EXPECT_NEAR(offset_from(lines, {20, 15.2}), -0.2, 1e-4);
}

}  // namespace
}  // namespace keyline::testing
