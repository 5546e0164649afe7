// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/simd/nms.h"

#include "tests/support/rows.h"
#include "tests/support/targets.h"

#include <array>

namespace keyline {
namespace {

using simd::Margin;
using simd::Rows3;
using test::GuardedRow;

// The formula of nms.h word for word.
bool kept(const Rows3& magnitude, float dx, float dy, int i) {
    const float* rows[3] = {magnitude.above, magnitude.at, magnitude.below};
    const auto m = [&](int x, int y) { return rows[1 + y][i + x]; };
    const int sx = dx < 0 ? -1 : 1, sy = dy < 0 ? -1 : 1;
    float a, b;
    if (std::fabs(dx) >= std::fabs(dy)) {
        const float w = std::fabs(dy) / std::fabs(dx);
        a = m(-sx, 0) + w * (m(-sx, -sy) - m(-sx, 0));
        b = m(sx, 0) + w * (m(sx, sy) - m(sx, 0));
    } else {
        const float w = std::fabs(dx) / std::fabs(dy);
        a = m(0, -sy) + w * (m(-sx, -sy) - m(0, -sy));
        b = m(0, sy) + w * (m(sx, sy) - m(0, sy));
    }
    return m(0, 0) > 0 && a <= m(0, 0) && b < m(0, 0);
}

void check(int n, Margin margin, std::vector<float> (*make)(int, unsigned), unsigned seed) {
    const int stride = n + 2;
    const auto pixels = make(3 * stride, seed);
    auto dx = make(n, seed + 10), dy = make(n, seed + 20);
    for (float& v : dx) v -= 1;  // of both signs alike
    for (float& v : dy) v -= 1;
    const float* at = pixels.data() + stride + 1;
    const Rows3 magnitude{at - stride, at, at + stride};
    std::vector<float> expected[3];
    for (int i = 0; i < n; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const bool end = (i == 0 && margin.before == 0) || (i == n - 1 && margin.after == 0);
        const bool keep = !end && kept(magnitude, dx[k], dy[k], i);
        expected[0].push_back(keep ? dx[k] : 0);
        expected[1].push_back(keep ? dy[k] : 0);
        expected[2].push_back(keep ? at[i] : 0);
    }
    GuardedRow out[3] = {GuardedRow(n), GuardedRow(n, 1), GuardedRow(n, 2)};
    simd::nms_row(magnitude, dx.data(), dy.data(), n, margin, {out[0].data(), out[1].data(), out[2].data()});
    for (int k = 0; k < 3; ++k) test::expect_row(out[k], expected[k]);
}

TEST(NmsRow, IsTheFormulaOnEveryTarget) {
    test::on_every_target([] {
        for (int n = 0; n <= 70; ++n) {
            check(n, {n % 2, n / 2 % 2}, test::awkward_row, static_cast<unsigned>(n));
            check(n, {n % 2, n / 2 % 2}, test::plain_row, static_cast<unsigned>(n));
        }
    });
}

// Runs one pixel in the middle of a 3×3 neighbourhood.
float middle(const std::array<float, 9>& m, float dx, float dy) {
    float out_dx, out_dy, out;
    simd::nms_row({m.data() + 1, m.data() + 4, m.data() + 7}, &dx, &dy, 1, {1, 1}, {&out_dx, &out_dy, &out});
    return out;
}

TEST(NmsRow, OfAPlateauTheSecondPixelIsSuppressed) {
    // Two equal magnitudes side by side: A may be equal, B may not, so the one further along the gradient
    // stays.
    EXPECT_EQ(middle({0, 0, 0, 5, 5, 1, 0, 0, 0}, 1, 0), 5.0F);
    EXPECT_EQ(middle({0, 0, 0, 1, 5, 5, 0, 0, 0}, 1, 0), 0.0F);
    EXPECT_EQ(middle({0, 0, 0, 5, 5, 1, 0, 0, 0}, -1, 0), 0.0F);
}

TEST(NmsRow, ComparesAlongTheGradientsDiagonal) {
    EXPECT_EQ(middle({9, 0, 0, 0, 5, 0, 0, 0, 0}, 1, 1), 0.0F);
    EXPECT_EQ(middle({9, 0, 0, 0, 5, 0, 0, 0, 9}, 1, -1), 5.0F);
    EXPECT_EQ(middle({0, 0, 9, 0, 5, 0, 0, 0, 0}, -1, 1), 0.0F);
}

TEST(NmsRow, OnAPlateauNeighboursAreInterpolatedExactly) {
    const float m = 0.1F;
    for (float w = 0; w <= 1; w += 0.01F) EXPECT_EQ(middle({m, m, m, m, m, 0, 0, 0, 0}, 1, w), m) << w;
}

TEST(NmsRow, MinusZeroCountsAsPlus) {
    const std::array<float, 9> m = {0, 1, test::kInfinity, 0, 5, 0, 0, 1, 0};
    EXPECT_EQ(middle(m, 0.0F, 1), 5.0F);
    EXPECT_EQ(middle(m, -0.0F, 1), 5.0F);
}

TEST(NmsRow, LeavesOutRowsThatAreNotWanted) {
    const std::vector<float> m = {0, 0, 0, 1, 5, 1, 0, 0, 0}, along = {1}, across = {0};
    float out = 0;
    simd::nms_row({&m[1], &m[4], &m[7]}, along.data(), across.data(), 1, {1, 1}, {nullptr, nullptr, &out});
    EXPECT_EQ(out, 5.0F);
}

TEST(NmsRow, ANanSuppresses) {
    EXPECT_EQ(middle({0, 0, 0, test::kNan, 5, 0, 0, 0, 0}, 1, 0), 0.0F);
    EXPECT_EQ(middle({0, 0, 0, 0, 5, 0, 0, 0, 0}, test::kNan, 1), 0.0F);
    EXPECT_EQ(middle({0, 0, 0, 0, 5, 0, 0, 0, 0}, 1, test::kNan), 0.0F);
    EXPECT_EQ(middle({0, 0, 0, 0, test::kNan, 0, 0, 0, 0}, 1, 0), 0.0F);
    EXPECT_EQ(middle({0, 0, 0, 0, 5, 0, 0, 0, 0}, 0, 0), 0.0F);
}

}  // namespace
}  // namespace keyline
