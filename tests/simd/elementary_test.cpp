// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/simd/elementary.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace keyline {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kSmallest = std::numeric_limits<double>::denorm_min();

// How far `value` is from `expected`, as a part of it.
double relative_error(double value, long double expected) {
    return static_cast<double>(std::fabs((static_cast<long double>(value) - expected) / expected));
}

TEST(Exp, IsAccurate) {
    std::mt19937_64 random(1);
    double worst = 0;
    for (int i = 0; i < 100'000; ++i) {
        const double x =
            std::uniform_real_distribution<double>(i % 2 == 0 ? -708 : -2, i % 2 == 0 ? 709 : 2)(random);
        worst = std::max(worst, relative_error(elementary::exp(x), std::exp(static_cast<long double>(x))));
    }
    EXPECT_LT(worst, 1e-15);
}

TEST(Exp, ReachesDenormalsAndBothEnds) {
    for (double x = -745; x < -708; x += 0.37)
        EXPECT_NEAR(elementary::exp(x), static_cast<double>(std::exp(static_cast<long double>(x))), kSmallest)
            << x;
    EXPECT_EQ(elementary::exp(0.0), 1.0);
    EXPECT_EQ(elementary::exp(-0.0), 1.0);
    EXPECT_LT(elementary::exp(709.78), kInfinity);
    EXPECT_EQ(elementary::exp(709.79), kInfinity);
    EXPECT_EQ(elementary::exp(-746.0), 0.0);
    EXPECT_EQ(elementary::exp(kInfinity), kInfinity);
    EXPECT_EQ(elementary::exp(-kInfinity), 0.0);
    EXPECT_TRUE(std::isnan(elementary::exp(kNan)));
}

TEST(Log, IsAccurate) {
    std::mt19937_64 random(2);
    double worst = 0;
    for (int i = 0; i < 100'000; ++i) {
        const double magnitude = std::uniform_real_distribution<double>(-1074, 1024)(random);
        const double near_one = std::uniform_real_distribution<double>(-1, 1)(random);
        const double x = i % 2 == 0 ? std::exp2(magnitude) : std::exp2(near_one);
        if (x != 1)
            worst =
                std::max(worst, relative_error(elementary::log(x), std::log(static_cast<long double>(x))));
    }
    EXPECT_LT(worst, 1e-15);
    for (const double x :
         {1 + 0x1p-52, 1 - 0x1p-53, 1 + 0x1p-26, kSmallest, std::numeric_limits<double>::max(),
          0x1.6a09e667f3bccp-1, 0x1.6a09e667f3bcdp-1, 0x1.6a09e667f3bcdp0})
        EXPECT_LT(relative_error(elementary::log(x), std::log(static_cast<long double>(x))), 1e-15) << x;
}

TEST(Log, HandlesWhatHasNoLogarithm) {
    EXPECT_EQ(elementary::log(1.0), 0.0);
    EXPECT_EQ(elementary::log(0.0), -kInfinity);
    EXPECT_EQ(elementary::log(-0.0), -kInfinity);
    EXPECT_EQ(elementary::log(kInfinity), kInfinity);
    EXPECT_TRUE(std::isnan(elementary::log(-1.0)));
    EXPECT_TRUE(std::isnan(elementary::log(-kInfinity)));
    EXPECT_TRUE(std::isnan(elementary::log(kNan)));
}

TEST(Pow, IsAccurate) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> base(0, 20), exponent(-6, 6);
    double worst = 0;
    for (int i = 0; i < 100'000; ++i) {
        const double x = base(random), y = exponent(random);
        const double allowance = 1 + std::fabs(y * std::log(x));
        const long double expected = std::pow(static_cast<long double>(x), static_cast<long double>(y));
        worst = std::max(worst, relative_error(elementary::pow(x, y), expected) / allowance);
    }
    EXPECT_LT(worst, 1e-15);
}

TEST(Pow, HasTheSpecialCasesOfIeee) {
    EXPECT_EQ(elementary::pow(0, 2), 0.0);
    EXPECT_EQ(elementary::pow(0, -2), kInfinity);
    EXPECT_EQ(elementary::pow(kNan, 0), 1.0);
    EXPECT_EQ(elementary::pow(1, kNan), 1.0);
    EXPECT_EQ(elementary::pow(kInfinity, 0.5), kInfinity);
    EXPECT_EQ(elementary::pow(kInfinity, -1), 0.0);
    EXPECT_TRUE(std::isnan(elementary::pow(-1, 2)));
    EXPECT_TRUE(std::isnan(elementary::pow(2, kNan)));
}

TEST(SinCos, IsAccurate) {
    std::mt19937_64 random(3);
    double worst = 0;
    for (int i = 0; i < 100'000; ++i) {
        const double degrees = std::uniform_real_distribution<double>(-1000, 1000)(random);
        const long double radians =
            std::fmod(static_cast<long double>(degrees), 360.0L) * std::acos(-1.0L) / 180;
        const auto [sine, cosine] = elementary::sin_cos_degrees(degrees);
        worst = std::max({worst, std::fabs(sine - static_cast<double>(std::sin(radians))),
                          std::fabs(cosine - static_cast<double>(std::cos(radians)))});
    }
    EXPECT_LT(worst, 1e-15);
}

TEST(SinCos, IsExactAtQuarterTurns) {
    for (int turn = -8; turn <= 8; turn += 4) {
        const auto at = [&](int quarter) { return elementary::sin_cos_degrees(90.0 * (turn + quarter)); };
        EXPECT_TRUE(at(0).sin == 0 && at(0).cos == 1);
        EXPECT_TRUE(at(1).sin == 1 && at(1).cos == 0);
        EXPECT_TRUE(at(2).sin == 0 && at(2).cos == -1);
        EXPECT_TRUE(at(3).sin == -1 && at(3).cos == 0);
    }
    EXPECT_TRUE(std::isnan(elementary::sin_cos_degrees(kInfinity).sin));
    EXPECT_TRUE(std::isnan(elementary::sin_cos_degrees(kNan).cos));
}

TEST(Probit, UndoesTheNormalDistribution) {
    double worst = 0;
    for (double x = -6.3; x <= 6.3; x += 0.001) {
        const double p = std::erfc(-x / std::sqrt(2.0)) / 2;
        if (p < 1e-10 || p > 1 - 1e-10) continue;
        // Near 1 the steps between doubles are wide.
        const double step = 1e-16 / (std::exp(-x * x / 2) / std::sqrt(2 * std::acos(-1.0)));
        worst = std::max(worst, (std::fabs(elementary::probit(p) - x) - step) / std::max(std::fabs(x), 0.1));
    }
    EXPECT_LT(worst, 2e-7);
    EXPECT_EQ(elementary::probit(0.5), 0);
    EXPECT_EQ(elementary::probit(0.25), -elementary::probit(0.75));
}

}  // namespace
}  // namespace keyline
