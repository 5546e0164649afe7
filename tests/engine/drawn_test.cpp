// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/measure/drawn.h"

#include "tests/support/strokes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <gmock/gmock.h>
#include <limits>
#include <numbers>

// What pictures of lines are measured to be, of which it is known.

namespace keyline::testing {
namespace {

constexpr Rect kFrame{0, 0, 100, 60};

DrawnLines picture(const std::function<double(int, int)>& coverage) {
    DrawnLines out{kFrame, {}};
    for (int y = kFrame.y0; y < kFrame.y1; ++y)
        for (int x = kFrame.x0; x < kFrame.x1; ++x)
            out.coverage.push_back(static_cast<float>(coverage(x, y)));
    return out;
}

// What a band from `y` − width / 2 to `y` + width / 2 has of a row of pixels.
double band(int row, double y, double width) {
    return std::clamp(std::min(row + 1.0, y + width / 2) - std::max<double>(row, y - width / 2), 0.0, 1.0);
}

Strokes line(double y) { return strokes_in(kFrame, {stroke({{5, y}, {95, y}})}); }

TEST(Drawn, AnEvenLineHasOneWidth) {
    const DrawnLines even = picture([](int, int y) { return band(y, 30.3, 2.6); });
    EXPECT_NEAR(width_in(line(30.3), even).spread, 0, 1e-6);
    EXPECT_NEAR(width_in(line(30.3), even).length, 70, 1) << "of 90, less 10 at each end";
    EXPECT_NEAR(width_in(line(30.8), even).spread, 0, 1e-6) << "wherever across it the stroke lies";
}

TEST(Drawn, TellsHowMuchAWidthSpreads) {
    for (const double much : {0.05, 0.1}) {
        const DrawnLines wavy = picture([&](int x, int y) {
            return band(y, 30.3, 3 * (1 + much * std::sin(2 * std::numbers::pi * (x + 0.5) / 10)));
        });
        // Half of the time a sine is above √½; between pixels' centres it is a little flatter.
        EXPECT_NEAR(width_in(line(30.3), wavy).spread, 1.4826 * std::numbers::sqrt2 / 2 * much, 0.12 * much);
    }
}

TEST(Drawn, WhatHasAnotherLineBesideItDoesNotCount) {
    const DrawnLines two =
        picture([](int x, int y) { return std::max(band(y, 30, 2), x % 8 < 4 ? band(y, 35, 2) : 0.0); });
    EXPECT_GT(width_in(line(30), two).spread, 0.05);
    EXPECT_EQ(
        width_in(strokes_in(kFrame, {stroke({{5, 30}, {95, 30}}), stroke({{5, 35}, {95, 35}})}), two).length,
        0);
}

TEST(Drawn, ReadsBetweenPixelsAndNothingOutside) {
    const DrawnLines one = picture([](int x, int y) {
        return x == 10 && y == 20 ? 0.8 : x == 0 ? std::nan("") : 0;
    });
    EXPECT_NEAR(one.at(10.5, 20.5), 0.8, 1e-6);
    EXPECT_NEAR(one.at(11, 20.5), 0.4, 1e-6);
    EXPECT_NEAR(one.at(11, 21), 0.2, 1e-6);
    EXPECT_EQ(one.at(0.5, 5), 0);
    EXPECT_EQ(one.at(-50, 1000), 0);
}

// Everything goes by (x, y) a frame, y down; what is farther than `far` stands still.
MotionPass motion(float x, float y, std::vector<float> depth = {}) {
    MotionPass out{kFrame, {}, std::move(depth)};
    const auto area = static_cast<std::size_t>(kFrame.area());
    const std::array values{-x, y, -x, y};
    for (std::size_t c = 0; c < 4; ++c) {
        out.vector[c].assign(area, values[c]);
        for (std::size_t i = 0; i < out.depth.size(); ++i)
            if (out.depth[i] > 5) out.vector[c][i] = 0;
    }
    return out;
}

DrawnLines dashes(int x0, int y0) {
    return picture([=](int x, int y) { return y == 30 + y0 && x >= 20 + x0 && x < 60 + x0 ? 0.7 : 0; });
}

TEST(Drawn, WhatMovesWithItsSurfaceDoesNotFlicker) {
    EXPECT_EQ(
        flicker_of(
            {{dashes(0, 0), motion(3, -2)}, {dashes(3, -2), motion(3, -2)}, {dashes(6, -4), motion(3, -2)}}),
        0);
    EXPECT_GT(flicker_of({{dashes(0, 0), motion(0, 0)}, {dashes(3, -2), motion(0, 0)}}).value(), 0.9);
}

TEST(Drawn, FlickerIsTheShareThatChanges) {
    const DrawnLines none = picture([](int, int) { return 0; });
    const DrawnLines half = picture([](int x, int y) { return y == 30 && x >= 20 && x < 40 ? 0.7 : 0; });
    const DrawnLines pale = picture([](int x, int y) { return y == 30 && x >= 20 && x < 60 ? 0.35 : 0; });
    EXPECT_EQ(flicker_of({{dashes(0, 0), motion(0, 0)}, {none, motion(0, 0)}}), 1);
    EXPECT_NEAR(flicker_of({{dashes(0, 0), motion(0, 0)}, {half, motion(0, 0)}}).value(), 0.5, 1e-6);
    EXPECT_NEAR(flicker_of({{pale, motion(0, 0)}, {dashes(0, 0), motion(0, 0)}}).value(), 0.5, 1e-6);
    EXPECT_FALSE(flicker_of({{none, motion(0, 0)}, {none, motion(0, 0)}}))
        << "nothing to compare is not calm";
    EXPECT_EQ(width_in(line(30), none).length, 0);
}

// A line goes with the nearer of what is on both sides of it; what comes out from behind that has no say.
TEST(Drawn, LinesMoveAsWhatTheyAreDrawnOn) {
    const auto box = [](int x0) {
        std::vector<float> depth;
        for (int y = kFrame.y0; y < kFrame.y1; ++y)
            for (int x = kFrame.x0; x < kFrame.x1; ++x)
                depth.push_back(x >= 40 + x0 && x < 70 + x0 ? 2.0F : 9.0F);
        return depth;
    };
    // Around a box that moves by 4, on its outside; and on the wall, where the box will be and has been.
    const auto drawn = [](int x0) {
        return picture([=](int x, int) {
            const bool around = x == 39 + x0 || x == 70 + x0, wall = x == 37 || x == 72;
            return around || (wall && (x < 39 + x0 || x > 70 + x0)) ? 1 : 0;
        });
    };
    const std::vector<DrawnFrame> frames{{drawn(0), motion(4, 0, box(0))}, {drawn(4), motion(4, 0, box(4))}};
    EXPECT_LT(flicker_of(frames).value(), 0.02);
    const std::vector<DrawnFrame> still{{drawn(0), motion(4, 0, box(0))}, {drawn(0), motion(4, 0, box(4))}};
    EXPECT_GT(flicker_of(still).value(), 0.4);
}

}  // namespace
}  // namespace keyline::testing
