// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/simd/plane_step.h"

#include "tests/support/rows.h"
#include "tests/support/targets.h"

#include <algorithm>
#include <array>

namespace keyline {
namespace {

using test::GuardedRow;

constexpr int kReach = 2;

std::vector<float> depths(int n, unsigned seed, bool awkward) {
    std::vector<float> row = awkward ? test::awkward_row(n, seed) : test::plain_row(n, seed);
    for (float& z : row) z += 1;
    return row;
}

double nearness(float z) { return z <= 0 ? 0 : 1 / double{z}; }

// Along one axis, of five in a row.
double step(const std::array<double, 5>& near) {
    const double difference = near[3] - near[1], by_first = difference - 2 * (near[1] - near[0]),
                 by_second = difference - 2 * (near[4] - near[3]), both = by_first * by_second;
    if (both != both) return both;
    if (!(both > 0)) return 0;
    const double less = std::fabs(by_first) < std::fabs(by_second) ? by_first : by_second;
    return less / std::max(near[1], near[3]);
}

void check(int n, bool known_x, bool known_y, unsigned seed, bool awkward) {
    const int width = n + 2 * kReach;
    std::array<std::vector<float>, 5> z;
    std::array<std::vector<double>, 5> near;
    std::array<const double*, 5> rows;
    for (std::size_t r = 0; r < 5; ++r) {
        z[r] = depths(width, seed + 100 * static_cast<unsigned>(r), awkward);
        near[r].resize(static_cast<std::size_t>(width));
        simd::nearness_row(z[r].data(), width, near[r].data());
        rows[r] = near[r].data() + kReach;
    }
    std::array<std::vector<float>, 3> expected;
    for (int i = 0; i < n; ++i) {
        std::array<double, 5> along, across;
        for (int k = -kReach; k <= kReach; ++k) {
            const auto at = static_cast<std::size_t>(k + kReach);
            along[at] = nearness(z[kReach][static_cast<std::size_t>(i + kReach + k)]);
            across[at] = nearness(z[at][static_cast<std::size_t>(i + kReach)]);
        }
        const double dx = known_x ? step(along) : 0, dy = known_y ? step(across) : 0;
        const std::array values{dx, dy, std::sqrt(dx * dx + dy * dy)};
        for (std::size_t k = 0; k < 3; ++k)
            expected[k].push_back(test::one_nan(static_cast<float>(values[k])));
    }
    std::array<GuardedRow, 3> out{GuardedRow(n), GuardedRow(n, 1), GuardedRow(n, 2)};
    simd::plane_step_row(rows, n, known_x, known_y, {out[0].data(), out[1].data(), out[2].data()});
    for (std::size_t k = 0; k < 3; ++k) test::expect_row(out[k], expected[k]);
}

TEST(PlaneStepRow, IsTheFormulaOnEveryTarget) {
    test::on_every_target([] {
        for (int n = 0; n <= 40; ++n)
            for (const bool awkward : {false, true}) {
                check(n, true, true, static_cast<unsigned>(n), awkward);
                check(n, n % 2 == 0, n % 3 == 0, static_cast<unsigned>(n), awkward);
            }
    });
}

}  // namespace
}  // namespace keyline
