// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/strokes.h"

#include <cmath>
#include <gmock/gmock.h>

namespace keyline::testing {
namespace {

constexpr Rect kFrame{0, 0, 400, 1080};

Stroke line(double dx = 0) {
    Places places;
    for (int i = 0; i <= 200; ++i) places.emplace_back(10.0 + i + dx, 50);
    Stroke s = stroke(places, 4);
    s.anchor = StrokeAnchor::kUv;
    for (std::size_t i = 0; i < s.vertices.size(); ++i)
        s.vertices[i].anchor = {0.013 * static_cast<double>(i), 0.3, 0};
    return s;
}

Stroke wobbled(const Stroke& s, const Json& params, int frame = 1) {
    return run_on_strokes("wobble", params, strokes_in(kFrame, {s}), {.frame = frame}).strokes.at(0);
}

std::vector<double> shifts(const Stroke& s) {
    std::vector<double> out;
    for (const StrokeVertex& v : s.vertices) out.push_back(v.y - 50);
    return out;
}

double most(const std::vector<double>& v) {
    double m = 0;
    for (const double d : v) m = std::max(m, std::fabs(d));
    return m;
}

TEST(Wobble, MovesAsideByItsAmountAtMost) {
    const Stroke s = wobbled(line(), {{"amount", 3}, {"breathe", 0}});
    EXPECT_GT(most(shifts(s)), 0.5);
    EXPECT_LE(most(shifts(s)), 3);
    for (std::size_t i = 0; i < s.vertices.size(); ++i) EXPECT_DOUBLE_EQ(s.vertices[i].x, 10.0 + double(i));
    for (const StrokeVertex& v : s.vertices) EXPECT_EQ(v.width, 4);
}

TEST(Wobble, HoldsADrawing) {
    const auto at = [](int frame) { return shifts(wobbled(line(), {{"hold", 3}, {"amount", 2}}, frame)); };
    EXPECT_EQ(at(3), at(4));
    EXPECT_EQ(at(4), at(5));
    EXPECT_NE(at(5), at(6));
    EXPECT_EQ(at(-3), at(-1));
    EXPECT_NE(at(-1), at(0));
    const auto still = [](int frame) { return shifts(wobbled(line(), {{"hold", 0}, {"amount", 2}}, frame)); };
    EXPECT_EQ(still(1), still(1000));
}

TEST(Wobble, StaysWithTheSurface) {
    for (const char* anchor : {"auto", "surface"})
        EXPECT_EQ(shifts(wobbled(line(), {{"anchor", anchor}})),
                  shifts(wobbled(line(37.5), {{"anchor", anchor}})));
    EXPECT_NE(shifts(wobbled(line(), {{"anchor", "screen"}})),
              shifts(wobbled(line(37.5), {{"anchor", "screen"}})));
}

TEST(Wobble, IsSmoothRoundAClosedStroke) {
    Places places;
    for (int i = 0; i < 120; ++i)
        places.emplace_back(100 + 30 * std::cos(i * M_PI / 60), 100 + 30 * std::sin(i * M_PI / 60));
    const Stroke s =
        wobbled(stroke(places, 2, StrokeKind::kOutline, true), {{"amount", 4}, {"anchor", "stroke"}});
    const std::size_t n = s.vertices.size();
    for (std::size_t i = 0; i < n; ++i) {
        const StrokeVertex &a = s.vertices[i], &b = s.vertices[(i + 1) % n];
        EXPECT_LT(std::fabs(std::hypot(b.x - a.x, b.y - a.y) - M_PI / 2), 0.8) << "no jump at " << i;
    }
}

TEST(Wobble, Breathes) {
    const Stroke s = wobbled(line(), {{"amount", 0}, {"breathe", 0.5}});
    double least = 4, greatest = 4;
    for (const StrokeVertex& v : s.vertices) {
        EXPECT_EQ(v.y, 50);
        least = std::min(least, v.width);
        greatest = std::max(greatest, v.width);
    }
    EXPECT_LT(least, 3.8);
    EXPECT_GT(greatest, 4.2);
    EXPECT_GE(least, 2);
    EXPECT_LE(greatest, 6);
}

TEST(Wobble, HasOtherHands) {
    EXPECT_NE(shifts(wobbled(line(), {{"seed", 1}})), shifts(wobbled(line(), {{"seed", 2}})));
}

TEST(Wobble, ScalesWithTheDisplay) {
    Strokes small = strokes_in({0, 0, 400, 540}, {line()});
    const double whole = most(shifts(wobbled(line(), {{"amount", 2}})));
    const double half = most(shifts(run_on_strokes("wobble", {{"amount", 2}}, small).strokes[0]));
    EXPECT_NEAR(half, whole / 2, 1e-9) << "the same waves, on the surface";
}

}  // namespace
}  // namespace keyline::testing
