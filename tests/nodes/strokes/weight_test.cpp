// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/strokes.h"

#include <cmath>
#include <gmock/gmock.h>

namespace keyline::testing {
namespace {

using ::testing::HasSubstr;

constexpr Rect kHalf{0, 0, 960, 540};  // a display of half of 1080

Stroke line(int n = 20) {
    Places places;
    for (int i = 0; i < n; ++i) places.emplace_back(10.0 + i, 10);
    return stroke(places);
}

std::vector<double> widths(const Stroke& s) {
    std::vector<double> out;
    for (const StrokeVertex& v : s.vertices) out.push_back(v.width);
    return out;
}

double width_of(const Strokes& in, const Json& params, std::size_t which = 0) {
    return run_on_strokes("weight", params, in).strokes.at(which).vertices[3].width;
}

TEST(Weight, IsMeasuredOnADisplayOf1080Lines) {
    const Strokes in = strokes_in(kHalf, {line()});
    EXPECT_DOUBLE_EQ(width_of(in, {{"width", 3}}), 1.5);
    EXPECT_DOUBLE_EQ(width_of(in, {{"width", 3}, {"units", "px"}}), 3);
}

TEST(Weight, MultipliesWhatWidthThereIs) {
    Stroke s = line();
    for (StrokeVertex& v : s.vertices) v.width = 0.5;
    EXPECT_DOUBLE_EQ(width_of(strokes_in(kHalf, {s}), {{"width", 3}, {"units", "px"}}), 1.5);
}

TEST(Weight, FallsWithDepth) {
    Stroke s = line();
    for (StrokeVertex& v : s.vertices) v.depth = 8;
    const auto at = [&](const Json& depth) {
        return width_of(strokes_in(kHalf, {s}),
                        {{"width", 1}, {"units", "px"}, {"min", 0}, {"by_depth", depth}});
    };
    EXPECT_DOUBLE_EQ(at({{"reference", 8}}), 1);
    EXPECT_NEAR(at({{"reference", 10}}), 1.25, 1e-12);
    EXPECT_NEAR(at({{"reference", 10}, {"power", 2}}), 1.5625, 1e-12);
    EXPECT_NEAR(at({{"reference", 1}}), 0.5, 1e-12) << "the least of its range";
    EXPECT_NEAR(at({{"reference", 100}}), 1.6, 1e-12) << "the most";
    s.vertices[3].depth = 0;
    EXPECT_GT(width_of(strokes_in(kHalf, {s}),
                       {{"width", 1}, {"units", "px"}, {"smooth", 0}, {"by_depth", Json{{"reference", 1}}}}),
              0.99)
        << "where it is not known";
}

TEST(Weight, GrowsWhereTheStrokeBends) {
    Stroke s = line();
    for (StrokeVertex& v : s.vertices) v.curvature = -0.05;
    const Json params{{"width", 1}, {"units", "px"}, {"by_curvature", 1}};
    EXPECT_DOUBLE_EQ(width_of(strokes_in(kHalf, {s}), params), 1.5) << "a radius of 20, either way";
}

TEST(Weight, TakesTheAngleBetweenTheSides) {
    Stroke s = line();
    const Json params{{"width", 1}, {"units", "px"}, {"by_angle", Json{0.5, 1.5}}};
    EXPECT_DOUBLE_EQ(width_of(strokes_in(kHalf, {s}), params), 0.5);
    for (StrokeVertex& v : s.vertices) v.sharpness = 90;
    EXPECT_DOUBLE_EQ(width_of(strokes_in(kHalf, {s}), params), 1);
    for (StrokeVertex& v : s.vertices) v.sharpness = 180;
    EXPECT_DOUBLE_EQ(width_of(strokes_in(kHalf, {s}), params), 1.5);
}

// Facing up in the upper half, turned by so many degrees in the lower; 50 high.
Image bent_by(double degrees) {
    const double angle = degrees * M_PI / 180;
    Image out({0, 0, 60, 50}, {"X", "Y", "Z"});
    out.fill("Y", [&](int, int y) { return y < 30 ? 1 : std::cos(angle); });
    out.fill("Z", [&](int, int y) { return y < 30 ? 0 : std::sin(angle); });
    return out;
}

TEST(Weight, SeesTheAngleInNormalsOnBothSides) {
    const Json params{
        {"width", 1}, {"units", "px"}, {"by_angle", Json{0, 2}}, {"min", 0}, {"normal", "normal"}};
    const auto vertex = [&](const Stroke& s, const Image& normals) {
        return run_on_strokes("weight", params, strokes_in({0, 0, 60, 50}, {s}), {}, {{"normal", normals}})
            .strokes.at(0)
            .vertices.at(1);
    };
    const Stroke right = stroke({{10, 30}, {20, 30}, {30, 30}}),
                 left = stroke({{30, 30}, {20, 30}, {10, 30}});
    for (const double degrees : {0.0, 1.0, 30.0, 89.0, 90.0, 120.0, 180.0})
        for (const Stroke& s : {right, left}) {
            const StrokeVertex v = vertex(s, bent_by(degrees));
            EXPECT_NEAR(v.sharpness, degrees, 0.02);
            EXPECT_NEAR(v.width, 1 - std::cos(degrees * M_PI / 180), 1e-3) << degrees;
        }
    Image half = bent_by(0);
    for (const char* axis : {"X", "Y", "Z"})
        half.fill(axis, [&](int, int y) { return *axis == 'Y' && y >= 30 ? 0.3 : 0; });
    EXPECT_EQ(vertex(right, half).sharpness, 180) << "before nothing";
    Stroke known = left;
    known.vertices[1].sharpness = 40;
    EXPECT_EQ(vertex(known, half).sharpness, 40) << "where no normal is known";
    const Image nan = bent_by(0).fill("X", [](int, int) { return std::nan(""); });
    EXPECT_EQ(vertex(known, nan).sharpness, 40);
}

TEST(Weight, ThinThingsMayBeDrawnAsThickAsTheyAre) {
    Stroke s = line();
    for (StrokeVertex& v : s.vertices) v.thickness = 1.2;
    const auto at = [&](double share) {
        return width_of(strokes_in(kHalf, {s}), {{"width", 4}, {"units", "px"}, {"as_thick", share}});
    };
    EXPECT_DOUBLE_EQ(at(0), 4);
    EXPECT_DOUBLE_EQ(at(1), 1.2);
    EXPECT_DOUBLE_EQ(at(0.5), 2.6);
    EXPECT_DOUBLE_EQ(width_of(strokes_in(kHalf, {line()}), {{"width", 4}, {"units", "px"}, {"as_thick", 1}}),
                     4)
        << "the middle of nothing";
}

TEST(Weight, TakesKindsAndObjectsByName) {
    std::vector<Stroke> strokes{line(), line(), line(), line()};
    strokes[1].kind = strokes[2].kind = strokes[3].kind = StrokeKind::kCrease;
    strokes[2].near = 1;
    strokes[3].near = 1;
    strokes[3].far = 2;
    Strokes in = strokes_in(kHalf, strokes);
    in.names = {{1, "hair.left"}, {2, "face"}};
    const Json params{{"width", 10},
                      {"units", "px"},
                      {"min", 0.1},
                      {"by_kind", Json{{"crease", 0.5}}},
                      {"by_object", Json{{"hair*", 0.4}, {"hair* x face*", 0}}}};
    EXPECT_DOUBLE_EQ(width_of(in, params, 0), 10);
    EXPECT_DOUBLE_EQ(width_of(in, params, 1), 5);
    EXPECT_DOUBLE_EQ(width_of(in, params, 2), 2);
    EXPECT_DOUBLE_EQ(width_of(in, params, 3), 0) << "a pair; 0 goes, whatever 'min' is";
}

TEST(Weight, HasALeast) {
    const Json params{{"width", 10}, {"units", "px"}, {"by_kind", Json{{"outline", 0.01}}}};
    EXPECT_DOUBLE_EQ(width_of(strokes_in(kHalf, {line()}), params), 3);
}

TEST(Weight, EvensOutSteps) {
    Stroke s = line(60);
    for (std::size_t i = 30; i < 60; ++i) s.vertices[i].width = 3;
    const std::vector<double> w = widths(
        run_on_strokes("weight", {{"width", 1}, {"units", "px"}, {"smooth", 8}}, strokes_in(kHalf, {s}))
            .strokes[0]);
    for (std::size_t i = 1; i < w.size(); ++i) {
        EXPECT_GE(w[i], w[i - 1] - 1e-12);
        EXPECT_LE(w[i] - w[i - 1], 0.26);
    }
    EXPECT_DOUBLE_EQ(w[10], 1);
    EXPECT_DOUBLE_EQ(w[50], 3);
}

TEST(Weight, EvensOutRoundAClosedStroke) {
    Places square;
    for (int i = 0; i < 10; ++i) square.emplace_back(10.0 + i, 10);
    for (int i = 0; i < 10; ++i) square.emplace_back(20, 10.0 + i);
    for (int i = 0; i < 10; ++i) square.emplace_back(20.0 - i, 20);
    for (int i = 0; i < 10; ++i) square.emplace_back(10, 20.0 - i);
    Stroke s = stroke(square, 1, StrokeKind::kOutline, true);
    s.vertices[0].width = 9;
    const std::vector<double> w = widths(
        run_on_strokes("weight", {{"width", 1}, {"units", "px"}, {"smooth", 4}}, strokes_in(kHalf, {s}))
            .strokes[0]);
    EXPECT_NEAR(w[1], w[39], 1e-12) << "on both sides of the first vertex alike";
    EXPECT_GT(w[39], 1.5);
}

TEST(Weight, TellsOfKindsThatThereAreNot) {
    const Strokes in = strokes_in(kHalf, {line()});
    try {
        run_on_strokes("weight", {{"by_kind", Json{{"creese", 1}}}}, in);
        FAIL();
    } catch (const Failure& f) {
        EXPECT_THAT(f.error().what, HasSubstr("there is no kind 'creese'; did you mean 'crease'?"));
    }
}

// Light on the lower half, from y = 30 on; the picture is 50 high.
Image half_lit() {
    return Image({0, 0, 60, 50}, {"Y"}).fill("Y", [](int, int y) { return y < 30 ? 0 : 1; });
}

std::vector<double> widths_by_map(const Stroke& s, const Image& map, Json params = {},
                                  const RunOptions& options = {}) {
    params.set("width", 2).set("units", "px").set("smooth", 0).set("map", "map");
    return widths(run_on_strokes("weight", params, strokes_in({0, 0, 60, 50}, {s}), options, {{"map", map}})
                      .strokes.at(0));
}

TEST(Weight, FollowsAMapBesideTheLineOnWhatItBelongsTo) {
    const Json factors{{"by_map", Json::array({1.5, 0.5})}};
    const Stroke right = stroke({{10, 29}, {20, 29}, {30, 29}}),
                 left = stroke({{30, 31}, {20, 31}, {10, 31}});
    EXPECT_THAT(widths_by_map(right, half_lit(), factors), ::testing::Each(1)) << "what is below it is lit";
    EXPECT_THAT(widths_by_map(left, half_lit(), factors), ::testing::Each(3));
    EXPECT_THAT(widths_by_map(right, half_lit()), ::testing::Each(2)) << "as the map is";
    EXPECT_THAT(widths_by_map(stroke({{50, 10}, {50, 20}, {50, 40}, {50, 45}}), half_lit(), factors),
                ::testing::ElementsAre(3, 3, 1, 1));
}

TEST(Weight, OutsideItsPictureAMapIsZeroAndNanChangesNothing) {
    const Json factors{{"by_map", Json::array({1.5, 0.5})}};
    EXPECT_THAT(widths_by_map(stroke({{10, 49}, {20, 49}}), half_lit(), factors), ::testing::Each(3));
    const Image nan = Image({0, 0, 60, 50}, {"Y"}).fill("Y", [](int, int) { return std::nan(""); });
    EXPECT_THAT(widths_by_map(stroke({{10, 20}, {20, 20}}), nan, factors), ::testing::Each(2));
}

TEST(Weight, AMapIsReadTheSameForAllTilesAndThreads) {
    const Image map =
        Image({0, 0, 60, 50}, {"Y"}).fill("Y", [](int x, int y) { return (x * 7 + y * 13) % 29 / 29.0; });
    for (unsigned seed = 1; seed < 4; ++seed) {
        const Strokes in = random_strokes(seed, {0, 0, 60, 50});
        const Json params{{"map", "map"}};
        const Strokes once = run_on_strokes("weight", params, in, {1, 0}, {{"map", map}});
        EXPECT_EQ(run_on_strokes("weight", params, in, {2, 7}, {{"map", map}}), once);
    }
}

// Two lines so far apart, both 2 pixels wide.
std::vector<double> widths_beside(double distance, double apart) {
    Places below;
    for (int i = 0; i < 60; ++i) below.emplace_back(20.0 + i, 10 + distance);
    Places above;
    for (int i = 0; i < 100; ++i) above.emplace_back(double(i), 10);
    Strokes out = run_on_strokes("weight", {{"width", 2}, {"units", "px"}, {"apart", apart}},
                                 strokes_in(kHalf, {stroke(above), stroke(below, 1, StrokeKind::kCrease)}));
    EXPECT_THAT(widths(out.strokes.at(0)), ::testing::Each(2)) << "the first stays";
    return widths(out.strokes.at(1));
}

TEST(Weight, WhatIsCloseToALineBeforeItGivesWay) {
    EXPECT_THAT(widths_beside(3.01, 1), ::testing::Each(2)) << "there is a pixel between them";
    EXPECT_THAT(widths_beside(2, 1), ::testing::Each(::testing::DoubleNear(1, 1e-9))) << "half of it";
    EXPECT_THAT(widths_beside(1, 1), ::testing::Each(0)) << "it would run inside the other";
    EXPECT_THAT(widths_beside(1.5, 0), ::testing::Each(::testing::DoubleNear(1, 1e-9)));
}

TEST(Weight, WhatCrossesALineOrGoesOnInItDoesNotGiveWay) {
    Places across, on;
    for (int i = 0; i < 20; ++i) across.emplace_back(20, 1.0 + i);
    for (int i = 0; i < 20; ++i) on.emplace_back(29.0 + i, 10);
    const Strokes out = run_on_strokes("weight", {{"width", 2}, {"units", "px"}, {"apart", 2}},
                                       strokes_in(kHalf, {line(), stroke(across, 1, StrokeKind::kFold),
                                                          stroke(on, 1, StrokeKind::kCrease)}));
    for (const Stroke& s : out.strokes) EXPECT_THAT(widths(s), ::testing::Each(2));
}

// The two sides of something thin are one line.
TEST(Weight, AStrokeThatComesBackGivesWayToItself) {
    Places there_and_back;
    for (int i = 0; i < 60; ++i) there_and_back.emplace_back(20.0 + i, 10);
    for (int i = 59; i >= 0; --i) there_and_back.emplace_back(20.0 + i, 10.8);
    const std::vector<double> w =
        widths(run_on_strokes("weight", {{"width", 2}, {"units", "px"}, {"apart", 1}},
                              strokes_in(kHalf, {stroke(there_and_back)}))
                   .strokes.at(0));
    for (std::size_t i = 0; i < 50; ++i) EXPECT_EQ(w[i], 2) << i;
    for (std::size_t i = 75; i < 115; ++i) EXPECT_EQ(w[i], 0) << i;
}

}  // namespace
}  // namespace keyline::testing
