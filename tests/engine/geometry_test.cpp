// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/base/geometry.h"

#include <gtest/gtest.h>

namespace keyline {
namespace {

TEST(Rect, IsHalfOpen) {
    constexpr Rect r{-2, 1, 3, 4};
    static_assert(r.width() == 5 && r.height() == 3 && r.area() == 15);
    EXPECT_TRUE(r.contains(-2, 1));
    EXPECT_FALSE(r.contains(3, 1));
    EXPECT_TRUE(r.contains(Rect{}));
    EXPECT_TRUE(r.contains(r));
}

TEST(Rect, EmptyIntersectionsCompareEqual) {
    EXPECT_EQ(intersect({0, 0, 2, 2}, {2, 0, 4, 2}), Rect{});
    EXPECT_EQ(intersect({0, 0, 2, 2}, {1, 1, 4, 2}), (Rect{1, 1, 2, 2}));
}

TEST(Rect, AnEmptyOneAddsNothingAndDoesNotGrow) {
    EXPECT_EQ(unite({5, 5, 5, 9}, {0, 0, 2, 2}), (Rect{0, 0, 2, 2}));
    EXPECT_EQ(unite({0, 0, 2, 2}, {-1, 3, 0, 4}), (Rect{-1, 0, 2, 4}));
    EXPECT_EQ(grow({5, 5, 5, 9}, {3, 3}), Rect{});
    EXPECT_EQ(grow({0, 0, 1, 1}, {1, 2}), (Rect{-1, -2, 2, 3}));
}

TEST(FloorDiv, RoundsDownOnBothSidesOfZero) {
    EXPECT_EQ(floor_div(7, 4), 1);
    EXPECT_EQ(floor_div(-1, 4), -1);
    EXPECT_EQ(floor_div(-4, 4), -1);
    EXPECT_EQ(floor_div(-5, 4), -2);
}

}  // namespace
}  // namespace keyline
