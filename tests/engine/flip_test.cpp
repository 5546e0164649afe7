// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/look/flip.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <numeric>

namespace keyline {
namespace {

constexpr int kWidth = 24, kHeight = 16;

std::size_t at(int x, int y) { return static_cast<std::size_t>(y * kWidth + x); }

LinearPicture slope_of_colours() {
    LinearPicture out{kWidth, kHeight, {}};
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            out.rgb[0].push_back(static_cast<float>(x / 23.0 * 0.8));
            out.rgb[1].push_back(static_cast<float>(y / 15.0 * 0.6));
            out.rgb[2].push_back(0.3F);
        }
    return out;
}

void set(LinearPicture& picture, int x, int y, std::array<float, 3> colour) {
    for (std::size_t c = 0; c < 3; ++c) picture.rgb[c][at(x, y)] = colour[c];
}

// The same with a red card and a dark line.
LinearPicture changed() {
    LinearPicture out = slope_of_colours();
    for (int y = 5; y < 9; ++y)
        for (int x = 6; x < 11; ++x) set(out, x, y, {0.9F, 0.05F, 0.1F});
    for (int y = 0; y < kHeight; ++y) set(out, 18, y, {0.02F, 0.02F, 0.02F});
    return out;
}

TEST(Flip, OfAPictureAndItselfIsNothing) {
    const std::vector<float> map = flip(slope_of_colours(), slope_of_colours());
    EXPECT_EQ(*std::ranges::max_element(map), 0);
}

// Made with the paper's formulas as they stand there, each filter as one kernel of two dimensions, in Python.
TEST(Flip, IsWhatThePapersFormulasGive) {
    const std::vector<float> map = flip(slope_of_colours(), changed());
    constexpr double kNear = 1e-5;
    EXPECT_NEAR(std::accumulate(map.begin(), map.end(), 0.0) / static_cast<double>(map.size()), 0.15568583,
                kNear);
    EXPECT_NEAR(double{*std::ranges::max_element(map)}, 0.76756074, kNear);
    EXPECT_NEAR(double{map[at(8, 6)]}, 0.71179925, kNear);
    EXPECT_NEAR(double{map[at(18, 3)]}, 0.49570128, kNear);
    EXPECT_NEAR(double{map[at(13, 10)]}, 0.05174055, kNear);
    EXPECT_NEAR(double{map[at(23, 15)]}, 0.07608443, kNear);
}

TEST(Flip, IsTheSameBothWays) {
    EXPECT_EQ(flip(slope_of_colours(), changed()), flip(changed(), slope_of_colours()));
}

// From farther away there is less to be seen of what is small.
TEST(Flip, FineThingsFadeWithDistance) {
    LinearPicture black{32, 32, {}}, checks{32, 32, {}};
    for (int i = 0; i < 32 * 32; ++i)
        for (std::size_t c = 0; c < 3; ++c) {
            black.rgb[c].push_back(0.5F);
            checks.rgb[c].push_back((i + i / 32) % 2 == 0 ? 0.4F : 0.6F);
        }
    const auto mean = [&](double pixels_per_degree) {
        const auto map = flip(black, checks, pixels_per_degree);
        return std::accumulate(map.begin(), map.end(), 0.0);
    };
    EXPECT_GT(mean(20), 1.5 * mean(80));
}

}  // namespace
}  // namespace keyline
