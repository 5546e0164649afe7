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

// A surface that a pixel is `step` of, moved by whole pixels.
Image surface(double step, int moved = 0) {
    Image out(kFrame, {"X", "Y", "Z"});
    for (int y = kFrame.y0; y < kFrame.y1; ++y)
        for (int x = kFrame.x0; x < kFrame.x1; ++x) {
            out.at("X", x, y) = static_cast<float>(step * (x - moved));
            out.at("Y", x, y) = static_cast<float>(step * y);
            out.at("Z", x, y) = 1;
        }
    return out;
}

Stroke without_anchors(Stroke s) {
    s.anchor = StrokeAnchor::kNone;
    for (StrokeVertex& v : s.vertices) v.anchor = {};
    return s;
}

Stroke wobbled_on(const Image& places, const Stroke& s, const Json& params, int frame = 1) {
    return run_on_strokes("wobble", params, strokes_in(kFrame, {s}), {.frame = frame}, {{"surface", places}})
        .strokes.at(0);
}

TEST(Wobble, StaysWithThePassThatTellsPlaces) {
    const Stroke here = without_anchors(line()), there = without_anchors(line(37));
    const Json params{{"amount", 5}};
    const Stroke moved = wobbled_on(surface(0.25), here, params);
    EXPECT_GT(most(shifts(moved)), 1);
    EXPECT_EQ(moved.anchor, StrokeAnchor::kPosition);
    EXPECT_EQ(moved.vertices[20].anchor, (std::array{7.5, 13.0, 1.0})) << "beside it, on what it belongs to";
    EXPECT_EQ(shifts(moved), shifts(wobbled_on(surface(0.25, 37), there, params)));
    EXPECT_NE(shifts(moved), shifts(wobbled_on(surface(0.25), there, params)));
}

TEST(Wobble, WithinAHoldADrawingGoesWithItsSurface) {
    const Json params{{"amount", 5}, {"hold", 2}};
    const auto at = [&](int frame, int moved) {
        return shifts(wobbled_on(surface(0.25, moved), without_anchors(line(moved)), params, frame));
    };
    EXPECT_EQ(at(4, 0), at(5, 23)) << "to the bit, though it moved";
    EXPECT_NE(at(5, 23), at(6, 23)) << "and then it is drawn anew";
}

// How often a line goes from one side to the other.
int crossings(const std::vector<double>& v) {
    int count = 0;
    for (std::size_t i = 1; i < v.size(); ++i) count += (v[i - 1] < 0) != (v[i] < 0);
    return count;
}

TEST(Wobble, HasWavesOfOneLengthInThePictureHoweverLargeTheSurface) {
    const Json params{{"amount", 5}, {"octaves", 1}, {"scale", 10}};
    for (const double step : {0.001, 0.3, 0.4, 0.5, 0.7, 1.0, 90.0}) {
        const int count = crossings(shifts(wobbled_on(surface(step), without_anchors(line()), params)));
        EXPECT_GE(count, 10) << step;
        EXPECT_LE(count, 40) << step;
    }
    // As the surface comes nearer, waves change little by little.
    const auto near = [&](double step) {
        return shifts(wobbled_on(surface(step), without_anchors(line()), params));
    };
    for (const double step : {0.4, 0.799, 1.6}) {
        const std::vector<double> a = near(step), b = near(1.002 * step);
        for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 0.5) << step << " at " << i;
    }
    const Json fixed{{"amount", 5}, {"surface_scale", 10}, {"octaves", 1}};
    EXPECT_LE(crossings(shifts(wobbled_on(surface(0.01), without_anchors(line()), fixed))), 2);
}

TEST(Wobble, DoesNotJumpWhereTheSurfaceDoes) {
    Image torn = surface(0.25);
    for (int y = kFrame.y0; y < kFrame.y1; ++y)
        for (int x = 110; x < kFrame.x1; ++x) torn.at("X", x, y) += 1000;
    for (int y = kFrame.y0; y < kFrame.y1; ++y) torn.at("Z", 60, y) = std::nanf("");
    const std::vector<double> v =
        shifts(wobbled_on(torn, without_anchors(line()), {{"amount", 5}, {"scale", 48}, {"octaves", 1}}));
    EXPECT_GT(most(v), 1);
    for (std::size_t i = 1; i < v.size(); ++i) EXPECT_LT(std::fabs(v[i] - v[i - 1]), 1.5) << "at " << i;
}

TEST(Wobble, RefusesASurfaceThatNothingStaysWith) {
    EXPECT_THROW(wobbled_on(surface(1), line(), {{"anchor", "screen"}}), Failure);
    EXPECT_THROW(run_on_strokes("wobble", {{"amount", 1}}, strokes_in(kFrame, {line()}), {},
                                {{"surface", Image(kFrame, {"depth"})}}),
                 Failure);
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

// The same drawing at half the size has the same waves, half as high.
TEST(Wobble, ScalesWithTheDisplay) {
    const Stroke whole = line();
    Stroke half = whole;
    half.vertices.clear();
    for (std::size_t i = 0; i < whole.vertices.size(); i += 2) {
        half.vertices.push_back(whole.vertices[i]);
        half.vertices.back().x /= 2;
    }
    for (const Json& params :
         {Json{{"amount", 2}, {"octaves", 1}}, Json{{"amount", 2}, {"surface_scale", 0.4}}}) {
        const std::vector<double> large = shifts(wobbled(whole, params));
        const std::vector<double> small =
            shifts(run_on_strokes("wobble", params, strokes_in({0, 0, 400, 540}, {half})).strokes[0]);
        EXPECT_GT(most(large), 0.4);
        for (std::size_t i = 5; i + 5 < small.size(); ++i)
            EXPECT_NEAR(small[i], large[2 * i] / 2, 0.05) << "at " << i;
    }
}

}  // namespace
}  // namespace keyline::testing
