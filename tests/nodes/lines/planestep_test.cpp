// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/run.h"

#include <cmath>
#include <limits>

namespace keyline::testing {
namespace {

constexpr Rect kWindow{-3, 2, 21, 18};

template <class Depth>
Image steps(const Depth& depth) {
    return run("planestep", {}, Image(kWindow, {"Z"}).fill("Z", depth));
}

// A plane under the eye that runs away, as a camera sees it: nearness is linear in the picture.
double floor_depth(int x, int y) { return 1 / (0.02 + 0.01 * y + 0.002 * x); }

TEST(PlaneStep, APlaneHasNoneHoweverItRunsAway) {
    const Image out = steps(floor_depth);
    for (const float s : out.channel("magnitude").samples) ASSERT_NEAR(s, 0, 1e-6);
}

TEST(PlaneStep, ACreaseIsNone) {
    const Image out = steps([](int x, int) { return 1 / (0.2 + 0.01 * std::abs(x - 9)); });
    for (const float s : out.channel("magnitude").samples) ASSERT_NEAR(s, 0, 1e-6);
}

TEST(PlaneStep, IsAShareOfTheNearerDepthAndPointsToIt) {
    const Image out = steps([](int x, int) { return x < 9 ? 2 : 2.5; });
    const auto at = [&](int x) { return out.at("dx", x, 9); };
    EXPECT_NEAR(at(8), -0.2, 1e-6);
    EXPECT_NEAR(at(9), -0.2, 1e-6);
    EXPECT_EQ(at(7), 0) << "no lobe on either side";
    EXPECT_EQ(at(10), 0);
    EXPECT_EQ(out.at("dy", 8, 9), 0);
    EXPECT_NEAR(out.at("magnitude", 8, 9), 0.2, 1e-6);
}

TEST(PlaneStep, StandsOutOfTheSlopesOnBothSides) {
    const Image out = steps([](int x, int y) { return x < 9 ? 0.9 * floor_depth(x, y) : floor_depth(x, y); });
    for (int y = 5; y < 15; ++y) {
        EXPECT_NEAR(out.at("magnitude", 8, y), 0.1, 0.02) << y;
        EXPECT_NEAR(out.at("magnitude", 6, y), 0, 1e-6) << y;
    }
}

TEST(PlaneStep, TheSameAtAnyDistance) {
    const auto depth = [](double scale) { return [scale](int x, int) { return scale * (x < 9 ? 2 : 2.5); }; };
    EXPECT_IMAGE_NEAR(steps(depth(1)), steps(depth(1000)), 1e-6);
}

TEST(PlaneStep, WithNothingBehindItIsWhole) {
    const Image out = steps([](int, int y) { return y < 9 ? std::numeric_limits<double>::infinity() : 3; });
    EXPECT_EQ(out.at("dy", 5, 8), 1);
    EXPECT_EQ(out.at("dy", 5, 9), 1);
    const Image none = steps([](int, int y) { return y < 9 ? 0 : 3; });
    EXPECT_EQ(none.at("dy", 5, 8), 1);
}

TEST(PlaneStep, NanStaysWithinItsReach) {
    const Image out = steps([](int x, int y) { return x == 9 && y == 9 ? std::nan("") : 2; });
    EXPECT_TRUE(std::isnan(out.at("dx", 10, 9)));
    EXPECT_EQ(out.at("dx", 12, 9), 0);
    EXPECT_EQ(out.at("magnitude", 10, 10), 0);
}

}  // namespace
}  // namespace keyline::testing
