// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/node/node.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace keyline {
namespace {

TEST(Scratch, PiecesOfOneCallDoNotOverlap) {
    Scratch scratch;
    for (int round = 0; round < 3; ++round) {
        const auto a = scratch.take<int>(30'000), b = scratch.take<int>(50'000);
        std::ranges::fill(a, 1);
        std::ranges::fill(b, 2);
        EXPECT_EQ(std::ranges::count(a, 1), 30'000);
        scratch.reset();
    }
}

TEST(Scratch, NeedsThatGrowLeaveNothingBehind) {
    Scratch scratch;
    std::size_t most = 0;
    for (std::size_t n = 1'000; n < 300'000; n += 1'000) {
        for (int i = 0; i < 3; ++i) scratch.take<float>(n);
        most = 3 * n * sizeof(float);
        scratch.reset();
    }
    EXPECT_LE(scratch.bytes(), 2 * most);
}

}  // namespace
}  // namespace keyline
