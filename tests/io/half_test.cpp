// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/simd/half.h"

#include "tests/io/simd_targets.h"

#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace keyline {
namespace {

std::vector<uint16_t> every_half() {
    std::vector<uint16_t> halves(65536);
    std::iota(halves.begin(), halves.end(), uint16_t{0});
    return halves;
}

// The value of a half by its definition.
double value_of(uint16_t half) {
    const int exponent = (half >> 10) & 31, significand = half & 1023;
    const double magnitude =
        exponent == 0 ? std::ldexp(significand, -24) : std::ldexp(significand + 1024, exponent - 25);
    return (half & 0x8000) != 0 ? -magnitude : magnitude;
}

bool is_special(uint16_t half) { return (half & 0x7C00) == 0x7C00; }

std::vector<uint16_t> narrowed(const std::vector<float>& floats, std::size_t* overflows = nullptr) {
    std::vector<uint16_t> halves(floats.size());
    const std::size_t count = simd::float_to_half(floats.data(), halves.data(), floats.size());
    if (overflows != nullptr) *overflows = count;
    return halves;
}

TEST(HalfToFloat, IsExactForEveryHalf) {
    const std::vector<uint16_t> halves = every_half();
    on_every_target([&] {
        std::vector<float> floats(halves.size());
        simd::half_to_float(halves.data(), floats.data(), halves.size());
        for (std::size_t i = 0; i < halves.size(); ++i) {
            const auto bits = std::bit_cast<uint32_t>(floats[i]);
            const uint16_t half = halves[i];
            ASSERT_EQ(bits >> 31, half >> 15) << half;
            if (is_special(half))
                ASSERT_EQ(bits & 0x7FFFFFFF, 0x7F800000U | (half & 0x3FFU) << 13) << half;
            else
                ASSERT_EQ(static_cast<double>(floats[i]), value_of(half)) << half;
        }
    });
}

TEST(HalfToFloat, ComesBackTheSameForEveryHalf) {
    const std::vector<uint16_t> halves = every_half();
    on_every_target([&] {
        std::vector<float> floats(halves.size());
        simd::half_to_float(halves.data(), floats.data(), halves.size());
        std::size_t overflows = 1;
        ASSERT_EQ(narrowed(floats, &overflows), halves);
        EXPECT_EQ(overflows, 0U);
    });
}

// Between every two neighbouring halves: just above the lower, on the tie and both sides of it, just below
// the upper.
TEST(FloatToHalf, RoundsToNearestEvenAtEveryBoundary) {
    std::vector<float> floats;
    std::vector<uint16_t> expected;
    const auto add = [&](float value, unsigned half) {
        floats.insert(floats.end(), {value, -value});
        expected.insert(expected.end(), {static_cast<uint16_t>(half), static_cast<uint16_t>(half | 0x8000U)});
    };
    for (unsigned half = 0; half < 0x7BFF; ++half) {
        const double lower = value_of(static_cast<uint16_t>(half));
        const double upper = value_of(static_cast<uint16_t>(half + 1));
        const auto low = static_cast<float>(lower), high = static_cast<float>(upper);
        const auto tie = static_cast<float>((lower + upper) / 2);
        add(std::nextafter(low, high), half);
        add(std::nextafter(tie, low), half);
        add(tie, half + (half & 1U));
        add(std::nextafter(tie, high), half + 1);
        add(std::nextafter(high, low), half + 1);
    }
    on_every_target([&] { ASSERT_EQ(narrowed(floats), expected); });
}

TEST(FloatToHalf, CountsFiniteValuesThatBecomeInfinite) {
    const float infinity = std::numeric_limits<float>::infinity();
    const std::vector<float> floats = {65504.0F,
                                       65519.996F,
                                       65520.0F,
                                       -65520.0F,
                                       65536.0F,
                                       1e30F,
                                       infinity,
                                       -infinity,
                                       NAN,
                                       0.0F,
                                       -0.0F,
                                       -65504.0F,
                                       std::numeric_limits<float>::max()};
    on_every_target([&] {
        std::size_t overflows = 0;
        const std::vector<uint16_t> halves = narrowed(floats, &overflows);
        EXPECT_EQ(overflows, 5U);
        EXPECT_EQ(halves, (std::vector<uint16_t>{0x7BFF, 0x7BFF, 0x7C00, 0xFC00, 0x7C00, 0x7C00, 0x7C00,
                                                 0xFC00, 0x7E00, 0x0000, 0x8000, 0xFBFF, 0x7C00}));
    });
}

TEST(FloatToHalf, DenormalFloatsBecomeZeroAndNansStayNans) {
    const std::vector<float> floats = {std::numeric_limits<float>::denorm_min(),
                                       -0x1p-126F,
                                       0x1p-25F,
                                       0x1.000002p-25F,
                                       std::bit_cast<float>(0x7F800001U),
                                       std::bit_cast<float>(0xFFC02000U)};
    on_every_target([&] {
        EXPECT_EQ(narrowed(floats), (std::vector<uint16_t>{0, 0x8000, 0, 1, 0x7C01, 0xFE01}));
    });
}

// Rows of every length up to a few vectors, at odd places: nothing outside is touched.
TEST(FloatToHalf, TreatsTheEndsOfRowsLikeTheirMiddle) {
    on_every_target([&] {
        for (std::size_t n = 0; n < 40; ++n) {
            std::vector<float> floats(n + 2, 1.0F);
            std::vector<uint16_t> halves(n + 2, 0xABCD);
            floats[n] = 1e6F;
            const std::size_t overflows = simd::float_to_half(floats.data() + 1, halves.data() + 1, n);
            EXPECT_EQ(overflows, n == 0 ? 0U : 1U);
            EXPECT_EQ(halves.front(), 0xABCD);
            EXPECT_EQ(halves.back(), 0xABCD);
            for (std::size_t i = 1; i < n; ++i) ASSERT_EQ(halves[i], 0x3C00) << n;
        }
    });
}

TEST(UintToFloat, RoundsOnceAndCountsWhatAFloatCannotHold) {
    std::vector<uint32_t> values = {0,
                                    1,
                                    65535,
                                    65536,
                                    1U << 24,
                                    (1U << 24) + 1,
                                    (1U << 24) + 2,
                                    (1U << 24) + 3,
                                    0x7FFFFFFF,
                                    0x80000000,
                                    0xFFFFFF00,
                                    0xFFFFFF80,
                                    0xFFFFFFFF};
    for (uint32_t i = 0, x = 1; i < 5000; ++i) values.push_back(x = x * 1664525U + 1013904223U);
    std::size_t inexact = 0;
    std::vector<float> expected;
    for (const uint32_t value : values) {
        expected.push_back(static_cast<float>(value));
        if (static_cast<double>(expected.back()) != value) ++inexact;
    }
    on_every_target([&] {
        std::vector<float> floats(values.size());
        EXPECT_EQ(simd::uint_to_float(values.data(), floats.data(), values.size()), inexact);
        EXPECT_EQ(floats, expected);
    });
}

TEST(FloatToUint, RoundsClampsAndCounts) {
    const std::vector<float> floats = {
        0.0F,          -0.0F,         0.5F,          1.5F,
        2.5F,          2.4999998F,    -0.5F,         -0.6F,
        -1e9F,         2147483648.0F, 2147483520.0F, 4294967040.0F,
        4294967296.0F, 1e20F,         NAN,           std::numeric_limits<float>::infinity(),
        8388609.0F,    16777217.0F};
    const std::vector<uint32_t> expected = {
        0,           0,           0,           2,           2,           2, 0,           0,        0,
        2147483648U, 2147483520U, 4294967040U, 4294967295U, 4294967295U, 0, 4294967295U, 8388609U, 16777216U};
    on_every_target([&] {
        std::vector<uint32_t> values(floats.size());
        EXPECT_EQ(simd::float_to_uint(floats.data(), values.data(), floats.size()), 6U);
        EXPECT_EQ(values, expected);
    });
}

}  // namespace
}  // namespace keyline
