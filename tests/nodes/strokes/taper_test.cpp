// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/strokes.h"

#include <cmath>
#include <gmock/gmock.h>

namespace keyline::testing {
namespace {

constexpr Rect kFrame{0, 0, 200, 1080};

Stroke line(std::array<StrokeEnd, 2> ends = {StrokeEnd::kEnd, StrokeEnd::kEnd}) {
    Places places;
    for (int i = 0; i <= 100; ++i) places.emplace_back(10.0 + i, 10);
    Stroke s = stroke(places, 4);
    s.ends = ends;
    return s;
}

Stroke tapered(const Stroke& s, const Json& params) {
    return run_on_strokes("taper", params, strokes_in(kFrame, {s})).strokes.at(0);
}

TEST(Taper, EndsInTips) {
    const Stroke s = tapered(line(), {{"start", 20}, {"end", 40}});
    EXPECT_EQ(s.vertices[0].width, 0);
    EXPECT_NEAR(s.vertices[10].width, 4 * std::sqrt(0.75), 1e-12);
    EXPECT_EQ(s.vertices[20].width, 4);
    EXPECT_EQ(s.vertices[60].width, 4);
    EXPECT_NEAR(s.vertices[80].width, 4 * std::sqrt(0.75), 1e-12);
    EXPECT_EQ(s.vertices[100].width, 0);
}

TEST(Taper, HasShapes) {
    EXPECT_DOUBLE_EQ(tapered(line(), {{"start", 20}, {"shape", "linear"}}).vertices[5].width, 1);
    EXPECT_NEAR(tapered(line(), {{"start", 20}, {"shape", "power"}, {"power", 2}}).vertices[10].width, 1,
                1e-12);
}

TEST(Taper, TakesSharesAndPixelsOfTheFrame) {
    EXPECT_EQ(tapered(line(), {{"start", 0.5}, {"units", "share"}, {"end", 0}}).vertices[50].width, 4);
    EXPECT_LT(tapered(line(), {{"start", 0.5}, {"units", "share"}, {"end", 0}}).vertices[49].width, 4);
    Strokes small = strokes_in({0, 0, 200, 540}, {line()});
    EXPECT_EQ(run_on_strokes("taper", {{"start", 20}}, small).strokes[0].vertices[10].width, 4)
        << "of a display half as high";
    EXPECT_LT(run_on_strokes("taper", {{"start", 20}, {"units", "px"}}, small).strokes[0].vertices[10].width,
              4);
}

TEST(Taper, LeavesOtherEndsAlone) {
    const Stroke s = tapered(line({StrokeEnd::kRim, StrokeEnd::kOccluded}), {});
    EXPECT_EQ(s.vertices[0].width, 4);
    EXPECT_EQ(s.vertices[100].width, 0);
    EXPECT_EQ(tapered(line({StrokeEnd::kJoined, StrokeEnd::kRim}), {}).vertices[0].width, 4);
    EXPECT_EQ(tapered(line({StrokeEnd::kJoined, StrokeEnd::kRim}), {{"at", Json::array({"joined"})}})
                  .vertices[0]
                  .width,
              0);
    Stroke ring = line();
    ring.closed = true;
    EXPECT_EQ(tapered(ring, {}).vertices[0].width, 4);
}

TEST(Taper, SharesAStrokeThatIsTooShort) {
    const Stroke s = tapered(line(), {{"start", 300}, {"end", 100}, {"shape", "linear"}});
    EXPECT_NEAR(s.vertices[75].width, 4, 1e-9);
    EXPECT_NEAR(s.vertices[30].width, 1.6, 1e-9);
}

TEST(Taper, GoesOnBeyondTheEnd) {
    const Stroke s =
        tapered(line({StrokeEnd::kEnd, StrokeEnd::kRim}), {{"overshoot", 5}, {"start", 0}, {"end", 0}});
    EXPECT_EQ(s.vertices.size(), 102U);
    EXPECT_DOUBLE_EQ(s.vertices.front().x, 5);
    EXPECT_DOUBLE_EQ(s.vertices.back().x, 110);
    EXPECT_DOUBLE_EQ(s.vertices.back().arc, 105);
}

}  // namespace
}  // namespace keyline::testing
