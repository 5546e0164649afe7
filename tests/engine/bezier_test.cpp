// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/bezier.h"

#include <cmath>
#include <gtest/gtest.h>

namespace keyline {
namespace {

// How far a point is from curves at most, by many places on them.
double off(CurvePoint p, CurvePoint begin, const std::vector<Bezier>& curves) {
    double nearest = 1e9;
    CurvePoint a = begin;
    for (const Bezier& b : curves) {
        for (int i = 0; i <= 2000; ++i) {
            const double t = i / 2000.0, s = 1 - t;
            const double k0 = s * s * s, k1 = 3 * s * s * t, k2 = 3 * s * t * t, k3 = t * t * t;
            nearest = std::min(nearest, std::hypot(k0 * a.x + k1 * b[0].x + k2 * b[1].x + k3 * b[2].x - p.x,
                                                   k0 * a.y + k1 * b[0].y + k2 * b[1].y + k3 * b[2].y - p.y));
        }
        a = b[2];
    }
    return nearest;
}

std::vector<CurvePoint> circle(double radius) {
    std::vector<CurvePoint> out;
    const int n = static_cast<int>(2 * M_PI * radius);
    for (int i = 0; i < n; ++i)
        out.push_back({radius * std::cos(2 * M_PI * i / n), radius * std::sin(2 * M_PI * i / n)});
    return out;
}

TEST(Bezier, LeavesNoPointByMoreThanTheTolerance) {
    std::vector<CurvePoint> wave;
    for (int i = 0; i < 300; ++i) wave.push_back({i * 1.0, 20 * std::sin(i * 0.05) + 3 * std::sin(i * 0.31)});
    for (const double tolerance : {0.05, 0.2, 1.0}) {
        const auto curves = fit_beziers(wave, false, tolerance);
        for (const CurvePoint& p : wave) EXPECT_LE(off(p, wave[0], curves), tolerance + 0.01);
    }
}

TEST(Bezier, NeedsFew) {
    for (const double radius : {12.0, 60.0, 300.0})
        EXPECT_LE(fit_beziers(circle(radius), true, 0.2).size(), 8U) << radius;
    std::vector<CurvePoint> line;
    for (int i = 0; i < 100; ++i) line.push_back({i * 1.0, i * 0.5});
    EXPECT_EQ(fit_beziers(line, false, 0.2).size(), 1U);
}

TEST(Bezier, ClosesAClosedLine) {
    const auto points = circle(10);
    const auto curves = fit_beziers(points, true, 0.1);
    EXPECT_EQ(curves.back()[2].x, points[0].x);
    EXPECT_EQ(curves.back()[2].y, points[0].y);
}

TEST(Bezier, KeepsCorners) {
    std::vector<CurvePoint> points;
    for (int i = 0; i <= 20; ++i) points.push_back({i * 1.0, 0});
    for (int i = 1; i <= 20; ++i) points.push_back({20, i * 1.0});
    const auto curves = fit_beziers(points, false, 0.2);
    ASSERT_EQ(curves.size(), 2U);
    EXPECT_EQ(curves[0][2].x, 20);
    EXPECT_EQ(curves[0][2].y, 0);
}

TEST(Bezier, StaysOnTheWayBetweenPointsThatAreFarApart) {
    const std::vector<CurvePoint> sliver{{0, 0}, {40, 1}, {80, 0}, {80, 2}, {40, 2.5}, {0, 2}};
    CurvePoint a = sliver[0];
    for (const Bezier& b : fit_beziers(sliver, true, 0.2)) {
        for (int i = 0; i <= 50; ++i) {
            const double t = i / 50.0, s = 1 - t;
            const double y =
                s * s * s * a.y + 3 * s * s * t * b[0].y + 3 * s * t * t * b[1].y + t * t * t * b[2].y;
            EXPECT_GE(y, -0.25);
            EXPECT_LE(y, 2.75);
        }
        a = b[2];
    }
}

TEST(Bezier, BearsPointsThatCoincideOrAreFew) {
    EXPECT_TRUE(fit_beziers({}, false, 0.2).empty());
    EXPECT_TRUE(fit_beziers({{1, 1}}, false, 0.2).empty());
    EXPECT_FALSE(fit_beziers({{1, 1}, {1, 1}, {1, 1}}, true, 0.2).empty());
    EXPECT_FALSE(fit_beziers({{1, 1}, {2, 1}, {1, 1}, {2, 1}}, false, 0.01).empty());
}

}  // namespace
}  // namespace keyline
