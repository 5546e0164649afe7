// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/cryptomatte.h"
#include "engine/kit/stroke_doubles.h"
#include "engine/kit/stroke_index.h"
#include "engine/kit/stroke_joints.h"
#include "engine/node/datum.h"
#include "engine/plan/planner.h"
#include "tests/support/run.h"
#include "tests/support/scene.h"
#include "tests/support/strokes.h"

#include <cmath>
#include <gmock/gmock.h>

namespace keyline::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;

// A straight stroke with a vertex a pixel.
Stroke straight(Point from, Point to, StrokeKind kind = StrokeKind::kCrease, uint32_t near = 1) {
    Stroke out;
    out.kind = kind;
    out.near = out.far = near;
    const int n = static_cast<int>(std::ceil(std::hypot(to.x - from.x, to.y - from.y)));
    for (int i = 0; i <= n; ++i) {
        StrokeVertex v;
        v.x = from.x + (to.x - from.x) * i / n;
        v.y = from.y + (to.y - from.y) * i / n;
        out.vertices.push_back(v);
    }
    return out;
}

Stroke ring(Point centre, double radius) {
    Stroke out;
    out.kind = StrokeKind::kOutline;
    out.closed = true;
    for (int i = 0; i < 60; ++i) {
        StrokeVertex v;
        v.x = centre.x + radius * std::cos(i * 0.1047198);
        v.y = centre.y + radius * std::sin(i * 0.1047198);
        out.vertices.push_back(v);
    }
    return out;
}

TEST(Chain, EndsThatPointAtEachOtherAreJoined) {
    const auto joined = [](Point from, Point to) {
        return join_strokes({straight({0, 0}, {10, 0}), straight(from, to)}, 4, 30).size() == 1;
    };
    EXPECT_TRUE(joined({13, 0}, {22, 0}));
    EXPECT_FALSE(joined({13, 0}, {20, 0})) << "a gap that is nearly as long as the stroke";
    EXPECT_TRUE(joined({23, 0}, {13, 0})) << "a crease has no direction";
    EXPECT_TRUE(joined({13, 1}, {24, 3}));
    EXPECT_FALSE(joined({15, 0}, {20, 0})) << "too far";
    EXPECT_FALSE(joined({12, 3}, {20, 3})) << "beside";
    EXPECT_FALSE(joined({13, 0}, {13, 9})) << "it turns too much";
}

TEST(Chain, TheGapIsFilledWithAVertexAPixel) {
    const auto strokes = join_strokes({straight({0, 0}, {10, 0}), straight({13, 0}, {23, 0})}, 4, 30);
    ASSERT_EQ(strokes.size(), 1U);
    ASSERT_EQ(strokes[0].vertices.size(), 24U);
    for (int i = 0; i <= 23; ++i) EXPECT_NEAR(strokes[0].vertices[static_cast<std::size_t>(i)].x, i, 1e-9);
}

TEST(Chain, ARingIsClosedAcrossItsGap) {
    Stroke open = ring({20, 20}, 12);
    open.closed = false;
    open.vertices.resize(open.vertices.size() - 2);  // 3.8 pixels are missing
    const auto strokes = join_strokes({open}, 4, 60);
    ASSERT_EQ(strokes.size(), 1U);
    EXPECT_TRUE(strokes[0].closed);
    for (const StrokeVertex& v : strokes[0].vertices)
        EXPECT_NEAR(std::hypot(v.x - 20, v.y - 20), 12, 0.2) << v.x << " " << v.y;
}

// What is looked up must not be searched for as far around as its longest piece reaches.
TEST(Chain, LinesOfFarVerticesAreFoundAtOnce) {
    Stroke far;
    for (const double x : {-1e6, 1e6}) {
        StrokeVertex v;
        v.x = x;
        far.vertices.push_back(v);
    }
    StrokeIndex index(2);
    index.add(far);
    for (int i = 0; i < 1000; ++i) {
        EXPECT_TRUE(index.has({i + 0.5, 1.5, 1, 0}));
        EXPECT_FALSE(index.has({i + 0.5, 2.5, 1, 0}));
    }
}

TEST(Chain, OnlyOneKindOfOneOwnerIsJoined) {
    const Stroke first = straight({0, 0}, {10, 0});
    EXPECT_EQ(join_strokes({first, straight({11, 0}, {20, 0}, StrokeKind::kLight)}, 4, 30).size(), 2U);
    EXPECT_EQ(join_strokes({first, straight({11, 0}, {20, 0}, StrokeKind::kCrease, 2)}, 4, 30).size(), 2U);
}

// An owner is on the right: two outlines that end in one point do not go on in
// each other.
TEST(Chain, OutlinesAreNotTurned) {
    const auto strokes = join_strokes(
        {straight({0, 0}, {10, 0}, StrokeKind::kOutline), straight({20, 0}, {10, 0}, StrokeKind::kOutline)},
        4, 30);
    EXPECT_EQ(strokes.size(), 2U);
}

TEST(Chain, AtAJunctionTheStraightestGoesOn) {
    const auto strokes = join_strokes(
        {straight({0, 0}, {10, 0}), straight({10, 0}, {18, 6}), straight({10, 0}, {20, 1})}, 4, 30);
    ASSERT_EQ(strokes.size(), 2U);
    EXPECT_EQ(strokes[0].vertices.front().x, 0);
    EXPECT_EQ(strokes[0].vertices.back().x, 20);
}

TEST(Chain, ALineThatComesBackIsClosed) {
    const auto strokes = join_strokes({straight({0, 0}, {10, 0}), straight({10, 0}, {10, 10}),
                                       straight({10, 10}, {0, 10}), straight({0, 10}, {0, 0})},
                                      4, 30);
    ASSERT_EQ(strokes.size(), 1U);
    EXPECT_TRUE(strokes[0].closed);
    EXPECT_EQ(strokes[0].vertices.size(), 40U);
}

TEST(Chain, LooseEndsGoOnToTheLineAhead) {
    const auto ahead_of = [](double x) {
        std::vector<Stroke> strokes{straight({0, 5}, {20, 5}),
                                    straight({x, 0}, {x, 10}, StrokeKind::kOutline)};
        meet_strokes(strokes, 4);
        return strokes[0];
    };
    EXPECT_NEAR(ahead_of(23).vertices.back().x, 23, 1e-9);
    EXPECT_EQ(ahead_of(23).ends, (std::array{StrokeEnd::kEnd, StrokeEnd::kJoined}));
    EXPECT_NEAR(ahead_of(-3).vertices.front().x, -3, 1e-9);
    EXPECT_NEAR(ahead_of(26).vertices.back().x, 26, 1e-9) << "straight as it is";
    EXPECT_EQ(ahead_of(29).vertices.back().x, 20) << "too far";
    std::vector<Stroke> shaky{straight({0, 5}, {30, 5}), straight({35, 0}, {35, 10}, StrokeKind::kOutline)};
    for (std::size_t i = 0; i < 31; ++i) shaky[0].vertices[i].y += i % 2 == 0 ? 0.3 : -0.3;
    meet_strokes(shaky, 4);
    EXPECT_EQ(shaky[0].ends[1], StrokeEnd::kEnd) << "nobody knows where to";
    std::vector<Stroke> whisker{straight({0, 5}, {30, 5}, StrokeKind::kRidge),
                                straight({33, 0}, {33, 10}, StrokeKind::kOutline)};
    for (StrokeVertex& v : whisker[0].vertices) v.thickness = 1;
    meet_strokes(whisker, 4);
    EXPECT_EQ(whisker[0].ends[1], StrokeEnd::kEnd) << "it is known where it ends";
    for (StrokeVertex& v : whisker[1].vertices) v.x = 31.5;
    meet_strokes(whisker, 4);
    EXPECT_EQ(whisker[0].ends[1], StrokeEnd::kJoined) << "at what it grows out of";
    std::vector<Stroke> beside{straight({0, 0}, {20, 0}), straight({22, 3}, {40, 3})};
    meet_strokes(beside, 4);
    EXPECT_EQ(beside[0].vertices.back().x, 20);
}

TEST(Chain, WhatRunsAlongAnEarlierStrokeGoes) {
    const Stroke first = straight({0, 0}, {20, 0}, StrokeKind::kOutline);
    const auto left = [&](const Stroke& s) { return without_doubles({first, s}, 1.5, 4).size() - 1; };
    EXPECT_EQ(left(straight({5, 1}, {15, 1})), 0U);
    EXPECT_EQ(left(straight({15, 1}, {5, 1})), 0U);
    EXPECT_EQ(left(straight({5, 2}, {15, 2})), 1U);
    EXPECT_EQ(left(straight({10, -5}, {10, 5})), 1U) << "it crosses";
    EXPECT_EQ(left(straight({15, 1}, {5, 1}, StrokeKind::kOutline)), 1U)
        << "the other side of something thin";
}

TEST(Chain, OfADoubleThatLeavesTheRestStays) {
    const auto strokes = without_doubles(
        {straight({0, 0}, {20, 0}, StrokeKind::kOutline), straight({10, 1}, {40, 1})}, 1.5, 4);
    ASSERT_EQ(strokes.size(), 2U);
    EXPECT_NEAR(strokes[1].vertices.front().x, 21, 1.5);
    EXPECT_EQ(strokes[1].ends[0], StrokeEnd::kJoined);
    EXPECT_EQ(strokes[1].vertices.back().x, 40);
}

// As where an outline is an intersection for a while.
TEST(Chain, AShortPieceBetweenTwoLinesStays) {
    const std::vector<Stroke> strokes{straight({0, 0}, {20, 0}, StrokeKind::kOutline),
                                      straight({23, 0}, {40, 0}, StrokeKind::kOutline),
                                      straight({20, 0}, {23, 0}, StrokeKind::kIntersection)};
    const auto kept = without_doubles(strokes, 1.5, 4);
    ASSERT_EQ(kept.size(), 3U);
    EXPECT_NEAR(length_of(kept[2]), 3, 1e-9);
}

TEST(Chain, WhatIsLeftOfADoubleStaysIfItLeadsToALine) {
    Stroke leaving = straight({0, 1}, {20, 1});
    for (int i = 1; i <= 3; ++i) {
        StrokeVertex v;
        v.x = 20;
        v.y = 1 + i;
        leaving.vertices.push_back(v);
    }
    const auto left = [&](StrokeEnd end) {
        leaving.ends[1] = end;
        return without_doubles({straight({0, 0}, {30, 0}, StrokeKind::kOutline), leaving}, 1.5, 6).size() - 1;
    };
    EXPECT_EQ(left(StrokeEnd::kEnd), 0U);
    EXPECT_EQ(left(StrokeEnd::kJoined), 1U);
}

TEST(Chain, ARingOpensWhereItIsADouble) {
    const auto strokes =
        without_doubles({straight({30, 0}, {30, 40}, StrokeKind::kCrease), ring({20, 20}, 10)}, 1, 4);
    ASSERT_EQ(strokes.size(), 2U);
    EXPECT_FALSE(strokes[1].closed);
    EXPECT_GT(length_of(strokes[1]), 45);
}

Strokes chained(const Scene& scene, Json params) {
    params.set("type", "chain").set("in", {"outlines"});
    const Json nodes{
        {"outlines", {{"type", "contours"}, {"in", "in"}, {"layer", "CryptoObject"}, {"depth", "in:Depth"}}},
        {"c", params}};
    render(make_plan(resolve_graph(nodes, {}, {{"in", {passes_of(scene)}}}, 1, true, {"c"}), {2, 16}));
    return datum_as<Strokes>(*rendered_data().front());
}

// Its outline is in two parts, against the one behind and against nothing.
TEST(Chain, AnObjectBeforeAnotherHasOneClosedOutline) {
    const Strokes strokes =
        chained({.things = {disc("behind", {18.2, 23.7}, 10, 5), disc("before", {30.4, 22.1}, 9, 4)}}, {});
    ASSERT_EQ(strokes.strokes.size(), 2U);
    for (const Stroke& s : strokes.strokes) {
        EXPECT_EQ(s.closed, s.near == cryptomatte_id("before"));
        EXPECT_EQ(strokes.names.count(s.near), 1U);
    }
}

TEST(Chain, ShortLooseStrokesGo) {
    const Scene scene{.things = {disc("a", {20, 20}, 3, 5)}};
    EXPECT_EQ(chained(scene, {{"min_length", 15}}).strokes.size(), 1U);
    EXPECT_EQ(chained(scene, {{"min_length", 25}}).strokes.size(), 0U);
}

std::vector<Stroke> chain_of(const std::vector<Stroke>& strokes) {
    const Json params{{"in", Json::array({"strokes"})}, {"min_length", 8}};
    return run_on_strokes("chain", params, strokes_in({0, 0, 60, 60}, strokes)).strokes;
}

TEST(Chain, WhatEndsInNothingOnBothSidesMustBeLonger) {
    const Stroke wall = straight({20, 0}, {20, 40}, StrokeKind::kOutline);
    EXPECT_THAT(chain_of({wall, straight({30, 20}, {40, 20})}), SizeIs(1));
    EXPECT_THAT(chain_of({wall, straight({30, 20}, {43, 20})}), SizeIs(2));
}

TEST(Chain, MiddlesOfThinThingsStay) {
    Stroke hair = straight({30, 20}, {35, 20}, StrokeKind::kRidge);
    EXPECT_THAT(chain_of({hair}), SizeIs(0));
    for (StrokeVertex& v : hair.vertices) v.thickness = 1;
    EXPECT_THAT(chain_of({hair}), SizeIs(1)) << "its outlines have gone already";
}

// It is no line at the end, so it is none at the beginning.
TEST(Chain, WhatIsTooShortCutsNothing) {
    const std::vector<Stroke> strokes =
        chain_of({straight({10, 20}, {50, 20}), straight({25, 20.5}, {32, 20.5}, StrokeKind::kFold)});
    ASSERT_THAT(strokes, SizeIs(1));
    EXPECT_EQ(length_of(strokes[0]), 40);
}

TEST(Chain, WantsStrokes) {
    const Json empty{{"c", {{"type", "chain"}, {"in", Json::array()}}}};
    EXPECT_THAT([&] { resolve_graph(empty, {}, {}, 1, true, {"c"}); },
                ::testing::ThrowsMessage<Failure>(HasSubstr("'in' is empty")));
}

}  // namespace
}  // namespace keyline::testing
