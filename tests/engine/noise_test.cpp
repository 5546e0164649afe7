// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace keyline {
namespace {

TEST(Noise, HasTheReferencesValue) { EXPECT_NEAR(noise::perlin(3.14, 42, 7), 0.13691995878400012, 1e-15); }

// On whole coordinates it rises towards the middle of an edge of a cube.
TEST(Noise, HasTheReferencesDirections) {
    constexpr double kStep = 1e-4;
    for (int i = 0; i < 500; ++i) {
        const double x = i % 17 - 8, y = i % 23 - 11, z = i % 29 - 14;
        std::array rise{std::abs(noise::perlin(x + kStep, y, z)) / kStep,
                        std::abs(noise::perlin(x, y + kStep, z)) / kStep,
                        std::abs(noise::perlin(x, y, z + kStep)) / kStep};
        std::ranges::sort(rise);
        ASSERT_NEAR(rise[0], 0, 1e-6) << i;
        ASSERT_NEAR(rise[1], 1, 1e-6) << i;
        ASSERT_NEAR(rise[2], 1, 1e-6) << i;
    }
}

TEST(Noise, IsAHalfOnWholeCoordinates) {
    for (const double x : {-300.0, -1.0, 0.0, 5.0, 255.0, 256.0, 1e15})
        for (const double y : {-2.0, 0.0, 77.0}) {
            EXPECT_EQ(noise::value(x), 0.5);
            EXPECT_EQ(noise::value(x, y), 0.5);
            EXPECT_EQ(noise::value(x, y, 3), 0.5);
        }
}

TEST(Noise, IsFromZeroToOneAndUsesMostOfIt) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> at(-300, 300);
    for (int dimensions = 1; dimensions <= 3; ++dimensions) {
        double least = 1, most = 0, sum = 0;
        constexpr int kCount = 200000;
        for (int i = 0; i < kCount; ++i) {
            const double v =
                noise::value(at(random), dimensions > 1 ? at(random) : 0, dimensions > 2 ? at(random) : 0);
            least = std::min(least, v);
            most = std::max(most, v);
            sum += v;
        }
        EXPECT_GE(least, 0);
        EXPECT_LE(most, 1);
        EXPECT_LT(least, 0.26) << dimensions;  // in one dimension it is ¼ to ¾
        EXPECT_GT(most, 0.74) << dimensions;
        EXPECT_NEAR(sum / kCount, 0.5, 0.02) << dimensions;
    }
}

TEST(Noise, HasNoSteps) {
    constexpr double kStep = 1e-4;
    for (double x = -3; x < 3; x += kStep) {
        ASSERT_NEAR(noise::value(x), noise::value(x + kStep), 2 * kStep) << x;
        ASSERT_NEAR(noise::value(0.3, x), noise::value(0.3, x + kStep), 2 * kStep) << x;
        ASSERT_NEAR(noise::value(0.3, -0.6, x), noise::value(0.3, -0.6, x + kStep), 2 * kStep) << x;
    }
}

TEST(Noise, MissingCoordinatesAreZero) {
    for (double x = -5; x < 5; x += 0.37) {
        EXPECT_EQ(noise::value(x), noise::value(x, 0, 0));
        EXPECT_EQ(noise::value(x, 1.7), noise::value(x, 1.7, 0));
        EXPECT_EQ(noise::signed_value(x), 2 * noise::value(x) - 1);
        EXPECT_EQ(noise::pair(x, 0.4).x, noise::value(x, 0.4));
        EXPECT_EQ(noise::pair(x, 0.4).y, noise::value(x + 71.37, 0.4 + 43.61));
    }
}

TEST(Noise, RepeatsEvery256) {
    EXPECT_EQ(noise::value(3.25, 7.5, 0.125), noise::value(3.25 + 256, 7.5 - 512, 0.125 + 2560));
}

TEST(Noise, IsNanWhereItHasNoPlace) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    EXPECT_TRUE(std::isnan(noise::value(kInfinity)));
    EXPECT_TRUE(std::isnan(noise::value(0, -kInfinity)));
    EXPECT_TRUE(std::isnan(noise::value(0, 0, std::numeric_limits<double>::quiet_NaN())));
    EXPECT_EQ(noise::value(1e300), 0.5);
}

}  // namespace
}  // namespace keyline
