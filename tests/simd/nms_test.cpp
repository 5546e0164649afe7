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

struct Rows {
    Rows3 magnitude, dx, dy;
};

// The formula of nms.h word for word.
bool kept(const Rows& rows, int i) {
    const auto at = [i](const Rows3& r, int x, int y) {
        const float* three[3] = {r.above, r.at, r.below};
        return three[1 + y][i + x];
    };
    const float dx = at(rows.dx, 0, 0), dy = at(rows.dy, 0, 0), m = at(rows.magnitude, 0, 0);
    const int sx = dx < 0 ? -1 : 1, sy = dy < 0 ? -1 : 1;
    const bool mostly_x = std::fabs(dx) >= std::fabs(dy);
    const float w = mostly_x ? std::fabs(dy) / std::fabs(dx) : std::fabs(dx) / std::fabs(dy);
    const auto side = [&](const Rows3& r, int sign) {
        const float axial = mostly_x ? at(r, sign * sx, 0) : at(r, 0, sign * sy);
        return axial + w * (at(r, sign * sx, sign * sy) - axial);
    };
    const float a = side(rows.magnitude, -1), b = side(rows.magnitude, 1);
    const float high = m * (1 + 0x1p-18F), low = m * (1 - 0x1p-18F);
    if (!(m > 0 && a <= high)) return false;
    return b < low || (b <= high && dx / m * side(rows.dx, 1) + dy / m * side(rows.dy, 1) < 0);
}

// Three rows with a margin of a pixel on both sides.
struct Three {
    std::vector<float> pixels;
    int stride;

    Three(int n, std::vector<float> (*make)(int, unsigned), unsigned seed, float offset)
        : pixels(make(3 * (n + 2), seed)), stride(n + 2) {
        for (float& v : pixels) v -= offset;
    }
    Rows3 rows() const {
        const float* at = pixels.data() + stride + 1;
        return {at - stride, at, at + stride};
    }
};

// Magnitudes that are about equal, of gradients that point both ways.
std::vector<float> tied_row(int n, unsigned seed) {
    std::vector<float> row = test::plain_row(n, seed);
    for (float& v : row) v = 1 + std::floor(v * 4) * 0x1p-20F;
    return row;
}

void check(int n, Margin margin, std::vector<float> (*make)(int, unsigned), unsigned seed,
           std::vector<float> (*vectors)(int, unsigned)) {
    const Three m(n, make, seed, 0), dx(n, vectors, seed + 10, 1), dy(n, vectors, seed + 20, 1);
    const Rows rows{m.rows(), dx.rows(), dy.rows()};
    std::vector<float> expected[3];
    for (int i = 0; i < n; ++i) {
        const bool end = (i == 0 && margin.before == 0) || (i == n - 1 && margin.after == 0);
        const bool keep = !end && kept(rows, i);
        expected[0].push_back(keep ? rows.dx.at[i] : 0);
        expected[1].push_back(keep ? rows.dy.at[i] : 0);
        expected[2].push_back(keep ? rows.magnitude.at[i] : 0);
    }
    GuardedRow out[3] = {GuardedRow(n), GuardedRow(n, 1), GuardedRow(n, 2)};
    simd::nms_row(rows.magnitude, rows.dx, rows.dy, n, margin, {out[0].data(), out[1].data(), out[2].data()});
    for (int k = 0; k < 3; ++k) test::expect_row(out[k], expected[k]);
}

TEST(NmsRow, IsTheFormulaOnEveryTarget) {
    test::on_every_target([] {
        for (int n = 0; n <= 70; ++n) {
            const Margin margin{n % 2, n / 2 % 2};
            const auto seed = static_cast<unsigned>(n);
            check(n, margin, test::awkward_row, seed, test::awkward_row);
            check(n, margin, test::plain_row, seed, test::plain_row);
            check(n, margin, tied_row, seed, test::plain_row);
        }
    });
}

// Runs one pixel in the middle of a 3×3 neighbourhood, whose others have the gradient (others_dx, 0).
float middle(const std::array<float, 9>& m, float dx, float dy, float others_dx = 1) {
    std::array<float, 9> x, y{};
    x.fill(others_dx);
    x[4] = dx, y[4] = dy;
    const auto rows = [](const std::array<float, 9>& a) {
        return Rows3{a.data() + 1, a.data() + 4, a.data() + 7};
    };
    float out_dx, out_dy, out;
    simd::nms_row(rows(m), rows(x), rows(y), 1, {1, 1}, {&out_dx, &out_dy, &out});
    return out;
}

TEST(NmsRow, WhatDiffersByRoundingIsEqual) {
    const float less = 5 * (1 - 0x1p-19F), more = 5 * (1 + 0x1p-19F), much_more = 5 * (1 + 0x1p-17F);
    for (const float m : {less, more}) {
        EXPECT_EQ(middle({0, 0, 0, m, 5, 1, 0, 0, 0}, 1, 0), 5.0F);
        EXPECT_EQ(middle({0, 0, 0, 1, 5, m, 0, 0, 0}, 1, 0), 0.0F);
    }
    EXPECT_EQ(middle({0, 0, 0, much_more, 5, 1, 0, 0, 0}, 1, 0), 0.0F);
    EXPECT_EQ(middle({0, 0, 0, 1, 5, 5 * (1 - 0x1p-17F), 0, 0, 0}, 1, 0), 5.0F);
}

TEST(NmsRow, AnEqualThatPointsTheOtherWayIsNoRival) {
    EXPECT_EQ(middle({0, 0, 0, 1, 5, 5, 0, 0, 0}, 1, 0, -1), 5.0F);
    EXPECT_EQ(middle({0, 0, 0, 5, 5, 1, 0, 0, 0}, -1, 0, 1), 5.0F);
    EXPECT_EQ(middle({0, 0, 0, 1, 5, 5.1F, 0, 0, 0}, 1, 0, -1), 0.0F);
    EXPECT_EQ(middle({0, 0, 0, 0, 1e-30F, 1e-30F, 0, 0, 0}, 1e-30F, 0, -1e-30F), 1e-30F);
}

TEST(NmsRow, AnInfiniteOneStandsOut) {
    EXPECT_EQ(middle({0, 0, 0, 1, test::kInfinity, 1, 0, 0, 0}, 1, 0), test::kInfinity);
}

TEST(NmsRow, OfAPlateauTheSecondPixelIsSuppressed) {
    // Two equal magnitudes side by side: A may be equal, B may not, so the one further along the gradient
    // stays.
    EXPECT_EQ(middle({0, 0, 0, 5, 5, 1, 0, 0, 0}, 1, 0), 5.0F);
    EXPECT_EQ(middle({0, 0, 0, 1, 5, 5, 0, 0, 0}, 1, 0), 0.0F);
    EXPECT_EQ(middle({0, 0, 0, 5, 5, 1, 0, 0, 0}, -1, 0, -1), 0.0F);
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
    const std::vector<float> m = {0, 0, 0, 1, 5, 1, 0, 0, 0};
    const Rows3 rows{&m[1], &m[4], &m[7]};
    float out = 0;
    simd::nms_row(rows, rows, rows, 1, {1, 1}, {nullptr, nullptr, &out});
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
