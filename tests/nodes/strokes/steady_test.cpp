// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/steady_strokes.h"
#include "engine/node/datum.h"
#include "engine/plan/planner.h"
#include "tests/support/run.h"
#include "tests/support/scene.h"
#include "tests/support/strokes.h"

#include <cmath>
#include <gmock/gmock.h>

namespace keyline::testing {
namespace {

using ::testing::SizeIs;

constexpr Rect kFrame{0, 0, 60, 40};

// From left to right at a height: what it belongs to is below.
Strokes level(double y, double width = 1, uint32_t near = 7) {
    Places places;
    for (int x = 10; x <= 50; ++x) places.emplace_back(x, y);
    Stroke s = stroke(places, width);
    s.near = near;
    return strokes_in(kFrame, {s});
}

const Strokes kNone = strokes_in(kFrame, {});

CarriedStrokes carried(const Strokes& strokes, bool seen = true) {
    std::size_t n = 0;
    for (const Stroke& s : strokes.strokes) n += s.vertices.size();
    return {strokes, std::vector<uint8_t>(n, seen ? 1 : 0)};
}

// Frames t − 2 … t + 2, all of which see all of each other.
Strokes among(const std::vector<Strokes>& frames, bool seen = true) {
    const std::size_t middle = frames.size() / 2;
    const CarriedStrokes from_here = carried(frames[middle], seen);
    std::vector<CarriedStrokes> there;
    for (const Strokes& f : frames) there.push_back(carried(f));
    std::vector<FrameBeside> beside;
    for (std::size_t i = 0; i < frames.size(); ++i)
        if (i != middle)
            beside.push_back({static_cast<int>(i) - static_cast<int>(middle), &there[i], &from_here});
    return steadied(frames[middle], beside);
}

std::vector<double> heights(const Strokes& s) {
    std::vector<double> out;
    for (const StrokeVertex& v : s.strokes.at(0).vertices) out.push_back(v.y);
    return out;
}

TEST(Steady, ALineLiesWhereFramesHaveItOnAverage) {
    const Strokes s = among({level(20.2), level(20.4), level(20), level(19.7), level(20.1)});
    const double mean = (1 * 0.2 + 3 * 0.4 + 4 * 0 - 3 * 0.3 + 1 * 0.1) / 12;
    for (const double y : heights(s)) EXPECT_NEAR(y, 20 + mean, 1e-9);
    for (const double y : heights(among({level(20.3), level(20), level(20)}))) EXPECT_NEAR(y, 20.075, 1e-9);
}

TEST(Steady, AndIsAsWideAsTheyHaveIt) {
    const Strokes s = among({level(20, 2), level(20, 1), level(20, 4)});
    for (const StrokeVertex& v : s.strokes.at(0).vertices) EXPECT_NEAR(v.width, (2 + 2 * 1 + 4) / 4.0, 1e-9);
}

TEST(Steady, OneThatFewFramesHaveGrowsThin) {
    const auto width = [](const std::vector<Strokes>& frames) {
        const Strokes s = among(frames);
        return s.strokes.empty() ? 0 : s.strokes[0].vertices[20].width;
    };
    const Strokes line = level(20);
    EXPECT_NEAR(width({line, line, line, line, line}), 1, 1e-9);
    EXPECT_NEAR(width({kNone, line, line, line, kNone}), 1, 1e-9) << "without strokes it has no say";
    const Strokes other = level(35);
    EXPECT_NEAR(width({other, other, line, line, line}), (8.0 / 12 - 0.2) / 0.7, 1e-9);
    EXPECT_NEAR(width({other, other, line, other, other}), (4.0 / 12 - 0.2) / 0.7, 1e-9);
}

TEST(Steady, OneThatBlinksIsThere) {
    const Strokes line = level(20), other = level(35);
    const Strokes s = among({other, line, other, level(20.4), other});
    ASSERT_THAT(s.strokes, SizeIs(2));
    EXPECT_NEAR(s.strokes[0].vertices[20].y, 20.2, 1e-9) << "half way";
    EXPECT_NEAR(s.strokes[0].vertices[20].width, (6.0 / 12 - 0.2) / 0.7, 1e-9);
    EXPECT_THAT(among({other, line, other, other, other}).strokes, SizeIs(1)) << "it has gone";
}

TEST(Steady, WhoCannotSeeAPlaceHasNoSay) {
    const Strokes line = level(20), other = level(35);
    const Strokes steady = among({other, other, line, other, other}, false);
    for (const StrokeVertex& v : steady.strokes.at(0).vertices) EXPECT_EQ(v.width, 1);
}

TEST(Steady, LinesOfOthersAreOthers) {
    for (const double y : heights(among({level(20.5, 1, 8), level(20), level(20.5, 1, 8)}))) EXPECT_EQ(y, 20);
}

// Where two things touch, noise says whose their line is.
TEST(Steady, ALineBetweenTwoMayBeEithersInTurn) {
    const auto between = [](double y, uint32_t near, uint32_t far) {
        Strokes s = level(y, 1, near);
        s.strokes[0].far = far;
        if (near > far) std::ranges::reverse(s.strokes[0].vertices);
        return s;
    };
    for (const double y : heights(among({between(20.4, 8, 7), between(20, 7, 8), between(20.4, 8, 7)})))
        EXPECT_NEAR(y, 20.2, 1e-9);
    for (const double y : heights(among({between(20.4, 8, 9), between(20, 7, 8), between(20.4, 9, 7)})))
        EXPECT_EQ(y, 20) << "of others";
}

constexpr int kLast = 5;

// A disc that moves by (1.6, −0.7) a frame; black after the last.  And how its pixels say that they do.
Image moving(int frame, int samples) {
    Scene scene{.window = {0, 0, 64, 48}, .things = {}};
    if (frame <= kLast) scene.things = {disc("a", {24 + 1.6 * frame, 26 - 0.7 * frame}, 11, 5)};
    return passes_of(scene, samples);
}

Image motion() {
    Image out({0, 0, 64, 48}, {"X", "Y", "Z", "W"});
    const auto is = [](double value) { return [value](int, int) { return value; }; };
    // It was there, y up, and will be at minus this.
    return out.fill("X", is(-1.6)).fill("Y", is(-0.7)).fill("Z", is(-1.6)).fill("W", is(-0.7));
}

double rms_off(int frame, int frames, const RunOptions& options = {}) {
    Sequences sequences;
    for (int f = 0; f <= kLast + 2; ++f) {
        sequences["in"].push_back(moving(f, 16));
        sequences["motion"].push_back(motion());
    }
    Json nodes{{"outlines", {{"type", "contours"}, {"in", "in"}, {"layer", "CryptoObject"}}}};
    if (frames > 0)
        nodes.set("s", {{"type", "steady"}, {"in", "outlines"}, {"vector", "motion"}, {"frames", frames}});
    const std::string result = frames > 0 ? "s" : "outlines";
    render(make_plan(resolve_graph(nodes, {}, sequences, frame, true, {result}),
                     {options.threads, options.tile}));
    const auto strokes = datum_as<Strokes>(*rendered_data().front());
    double sum = 0;
    std::size_t n = 0;
    for (const Stroke& s : strokes.strokes)
        for (const StrokeVertex& v : s.vertices) {
            const double off = std::hypot(v.x - 24 - 1.6 * frame, v.y - 26 + 0.7 * frame) - 11;
            sum += off * off;
            ++n;
        }
    EXPECT_GT(n, 50U);
    return std::sqrt(sum / static_cast<double>(n));
}

// Noise of sampling averages out.
TEST(Steady, IsNearerToTheTruthThanOneFrame) {
    const double alone = rms_off(2, 0), with_one = rms_off(2, 1), with_two = rms_off(2, 2);
    EXPECT_GT(alone, 0.04);
    EXPECT_LT(with_one, 0.85 * alone);
    EXPECT_LT(with_two, 0.78 * alone);
}

TEST(Steady, AtTheEndOfAShotItDoesWithFewer) { EXPECT_LT(rms_off(kLast, 2), 0.95 * rms_off(kLast, 0)); }

// One pixel in three shows it.
TEST(Steady, WhatIsThinGoesAsWhereItIsSeen) {
    const auto ways = [](bool is_middle) {
        FindWays::State state;
        for (uint32_t i = 0; i < 20; ++i) {
            state.push_back({i, 0, is_middle, true, 1, 2});
            state.push_back({i, 0, is_middle, false, i % 3 == 0 ? 6.0F : 1.0F, 2});
        }
        state.push_back({20, 1, is_middle, false, 30, 2});
        state.push_back({20, 1, is_middle, true, 1, 2});
        return FindWays::finish(state).ways;
    };
    const std::vector<StrokeWays::Way> middle = ways(true), edge = ways(false);
    for (std::size_t i = 0; i < 20; ++i) EXPECT_EQ(middle[i], (StrokeWays::Way{6, 2, true})) << i;
    EXPECT_EQ(middle[20], (StrokeWays::Way{30, 2, true})) << "another stroke's";
    EXPECT_EQ(edge[1], (StrokeWays::Way{1, 2, true}));
}

}  // namespace
}  // namespace keyline::testing
