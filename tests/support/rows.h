// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <span>
#include <vector>

// Rows of pixels for testing kernels, and their comparison bit by bit.

namespace keyline::test {

inline constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

inline constexpr float kSpecials[] = {0.0F,
                                      -0.0F,
                                      kInfinity,
                                      -kInfinity,
                                      kNan,
                                      -kNan,
                                      std::numeric_limits<float>::denorm_min(),
                                      -1e-40F,
                                      std::numeric_limits<float>::max(),
                                      -3e38F,
                                      std::numeric_limits<float>::min(),
                                      1.0F};

// Plausible pixels, some of them equal to their neighbour.
inline std::vector<float> plain_row(int n, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> value(-0.5F, 4.0F);
    std::vector<float> row(static_cast<std::size_t>(n));
    for (std::size_t i = 0; i < row.size(); ++i)
        row[i] = i > 0 && random() % 4 == 0 ? row[i - 1] : value(random);
    return row;
}

// The same with every sixth pixel or so a special value.
inline std::vector<float> awkward_row(int n, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<float> row = plain_row(n, seed + 1);
    for (float& value : row)
        if (random() % 6 == 0) value = kSpecials[random() % std::size(kSpecials)];
    return row;
}

// What a kernel makes of a NaN.
inline float one_nan(float value) { return std::isnan(value) ? kNan : value; }

inline void expect_same_bits(std::span<const float> actual, std::span<const float> expected) {
    ASSERT_EQ(actual.size(), expected.size());
    for (std::size_t i = 0; i < actual.size(); ++i)
        ASSERT_EQ(std::bit_cast<uint32_t>(actual[i]), std::bit_cast<uint32_t>(expected[i]))
            << "pixel " << i << " of " << actual.size() << " is " << actual[i] << ", expected "
            << expected[i];
}

// A row to write to with a guard behind it that must stay.
class GuardedRow {
public:
    explicit GuardedRow(int n, int offset = 0)
        : values_(static_cast<std::size_t>(n + offset) + kGuard, kUntouched),
          offset_(static_cast<std::size_t>(offset)),
          n_(static_cast<std::size_t>(n)) {}

    float* data() { return values_.data() + offset_; }
    std::span<const float> pixels() const { return std::span(values_).subspan(offset_, n_); }

    bool untouched_outside() const {
        for (std::size_t i = 0; i < values_.size(); ++i)
            if ((i < offset_ || i >= offset_ + n_) && values_[i] != kUntouched) return false;
        return true;
    }

private:
    static constexpr float kUntouched = 12345.0F;
    static constexpr std::size_t kGuard = 16;
    std::vector<float> values_;
    std::size_t offset_, n_;
};

// As GuardedRow's pixels: exactly as expected, and nothing written beside them.
inline void expect_row(const GuardedRow& actual, std::span<const float> expected) {
    expect_same_bits(actual.pixels(), expected);
    EXPECT_TRUE(actual.untouched_outside()) << "written outside the row";
}

}  // namespace keyline::test
