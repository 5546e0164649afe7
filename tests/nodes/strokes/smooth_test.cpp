// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/strokes.h"

#include <cmath>
#include <gmock/gmock.h>
#include <random>

namespace keyline::testing {
namespace {

constexpr Rect kFrame{0, 0, 200, 100};
constexpr double kTurn = 6.283185307179586;

// Places that are off by up to `tremor` either way.
Places shaken(Places places, double tremor) {
    std::mt19937 random(7);
    for (auto& [x, y] : places) {
        x += tremor * (static_cast<double>(random() % 2001) / 1000 - 1);
        y += tremor * (static_cast<double>(random() % 2001) / 1000 - 1);
    }
    return places;
}

Places circle(double radius) {
    Places out;
    const int n = static_cast<int>(kTurn * radius);
    for (int i = 0; i < n; ++i)
        out.emplace_back(90 + radius * std::cos(kTurn * i / n), 50 + radius * std::sin(kTurn * i / n));
    return out;
}

Places straight() {
    Places out;
    for (int i = 0; i <= 100; ++i) out.emplace_back(20.0 + i, 30.0 + 0.3 * i);
    return out;
}

Stroke smoothed(const Stroke& s, const Json& params = {{"tolerance", 0.06}}) {
    return run_on_strokes("smooth", params, strokes_in(kFrame, {s})).strokes.at(0);
}

template <class Off>
double rms(const Stroke& s, const Off& off) {
    double sum = 0;
    for (const StrokeVertex& v : s.vertices) sum += off(v) * off(v);
    return std::sqrt(sum / static_cast<double>(s.vertices.size()));
}

TEST(Smooth, TakesTheTremorOutOfAStraightLine) {
    const auto off = [](const StrokeVertex& v) { return ((v.y - 30) - 0.3 * (v.x - 20)) / std::sqrt(1.09); };
    const Stroke before = stroke(shaken(straight(), 0.1));
    EXPECT_LT(rms(smoothed(before), off), 0.35 * rms(before, off));
}

TEST(Smooth, NeitherShrinksNorLeavesACircle) {
    for (const double radius : {5.0, 12.0, 40.0}) {
        const auto off = [&](const StrokeVertex& v) { return std::hypot(v.x - 90, v.y - 50) - radius; };
        const Stroke s = smoothed(stroke(circle(radius), 1, StrokeKind::kOutline, true));
        double bias = 0;
        for (const StrokeVertex& v : s.vertices) bias += off(v) / static_cast<double>(s.vertices.size());
        EXPECT_LT(std::fabs(bias), 0.03) << radius;
        EXPECT_LT(rms(s, off), 0.04) << radius;
        for (const StrokeVertex& v : s.vertices)
            EXPECT_NEAR(v.curvature, 1 / radius, 0.05 / radius) << radius;
    }
}

TEST(Smooth, IsCalmerOnAShakenCircleToo) {
    const auto off = [](const StrokeVertex& v) { return std::hypot(v.x - 90, v.y - 50) - 30; };
    const Stroke before = stroke(shaken(circle(30), 0.1), 1, StrokeKind::kOutline, true);
    EXPECT_LT(rms(smoothed(before, {{"tolerance", 0.1}}), off), 0.6 * rms(before, off));
}

TEST(Smooth, KeepsACorner) {
    Places places;
    for (int i = 0; i < 30; ++i) places.emplace_back(20.0 + i, 50);
    for (int i = 0; i < 30; ++i) places.emplace_back(50, 50.0 + i);
    const Stroke s = smoothed(stroke(places));
    double nearest = 1;
    for (const StrokeVertex& v : s.vertices) nearest = std::min(nearest, std::hypot(v.x - 50, v.y - 50));
    EXPECT_LT(nearest, 0.05);
}

TEST(Smooth, MovesNoVertexFartherThanThreeTimesTheTolerance) {
    const Stroke before = stroke(shaken(circle(4), 0.6), 1, StrokeKind::kOutline, true);
    const Strokes in = strokes_in(kFrame, {before});
    for (const double tolerance : {0.01, 0.05, 0.2}) {
        const Stroke s = run_on_strokes("smooth", {{"tolerance", tolerance}}, in).strokes.at(0);
        for (const StrokeVertex& v : s.vertices) {
            double nearest = 100;
            for (const StrokeVertex& b : in.strokes[0].vertices)
                nearest = std::min(nearest, std::hypot(v.x - b.x, v.y - b.y));
            EXPECT_LE(nearest, 3 * tolerance + 1e-9);
        }
    }
}

TEST(Smooth, BelievesWhatTheStrokesSayOfTheirAccuracy) {
    Stroke exact = stroke(shaken(straight(), 0.1));
    EXPECT_EQ(smoothed(exact, {}).vertices[50].x, exact.vertices[50].x) << "an epsilon of 0";
    for (StrokeVertex& v : exact.vertices) v.epsilon = 0.1;
    EXPECT_NE(smoothed(exact, {}).vertices[50].x, exact.vertices[50].x);
}

TEST(Smooth, KeepsAJoinedEndWhereItIs) {
    Stroke s = stroke(shaken(straight(), 0.2));
    s.ends = {StrokeEnd::kJoined, StrokeEnd::kEnd};
    const Stroke out = smoothed(s, {{"tolerance", 0.3}});
    EXPECT_NEAR(out.vertices.front().x, s.vertices.front().x, 1e-3);
    EXPECT_NEAR(out.vertices.front().y, s.vertices.front().y, 1e-3);
}

TEST(Smooth, SimplifiesWhenAsked) {
    Places waves;
    for (int i = 0; i <= 120; ++i) waves.emplace_back(20.0 + i, 50 + 1.5 * std::sin(kTurn * i / 20));
    const auto off = [](const StrokeVertex& v) { return v.y - 50; };
    EXPECT_GT(rms(smoothed(stroke(waves)), off), 0.95);
    EXPECT_LT(rms(smoothed(stroke(waves), {{"tolerance", 0.06}, {"abstract", 8}}), off), 1.0);
}

TEST(Smooth, TurnsAndMirrorsWithTheDrawing) {
    const Stroke s = stroke(shaken(circle(12), 0.1), 1, StrokeKind::kOutline, true);
    Stroke moved = s;
    for (StrokeVertex& v : moved.vertices) v.x += 32;
    const Stroke a = smoothed(s), b = smoothed(moved);
    for (std::size_t i = 0; i < a.vertices.size(); ++i)
        EXPECT_NEAR(a.vertices[i].x + 32, b.vertices[i].x, 1e-9);
}

}  // namespace
}  // namespace keyline::testing
