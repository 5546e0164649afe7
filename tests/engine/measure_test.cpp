// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/measure/accuracy.h"
#include "engine/measure/form.h"
#include "engine/measure/motion.h"
#include "tests/support/strokes.h"

#include <cmath>
#include <gmock/gmock.h>
#include <numbers>

// What the measures say of drawings of which it is known.

namespace keyline::testing {
namespace {

using ::testing::SizeIs;

constexpr Rect kFrame{0, 0, 100, 100};

Strokes drawing(std::vector<Stroke> strokes) { return strokes_in(kFrame, std::move(strokes)); }

Stroke line(double x0, double y0, double x1, double y1, StrokeKind kind = StrokeKind::kOutline) {
    return stroke({{x0, y0}, {x1, y1}}, 1, kind);
}

// Clockwise, as seen, as outlines run.
Stroke circle(double radius, double width = 1) {
    Places places;
    const auto count = static_cast<int>(2 * std::numbers::pi * radius);
    for (int i = 0; i < count; ++i) {
        const double a = 2 * std::numbers::pi * i / count;
        places.emplace_back(50 + radius * std::cos(a), 50 + radius * std::sin(a));
    }
    return stroke(places, width, StrokeKind::kOutline, true);
}

Accuracy against(const Strokes& drawn, const Strokes& truth) { return accuracy_of(drawn, truth, {}); }

TEST(Accuracy, OfTheTruthItselfIsPerfect) {
    const Strokes truth = random_strokes(3, kFrame);
    const Accuracy a = against(truth, truth);
    EXPECT_EQ(a.recall, 1);
    EXPECT_EQ(a.offsets.rms, 0);
    EXPECT_THAT(a.missed.strokes, SizeIs(0));
}

TEST(Accuracy, OffsetsAreAcrossTheLineAndPositiveOutside) {
    const Accuracy a = against(drawing({circle(20.25)}), drawing({circle(20)}));
    EXPECT_EQ(a.precision, 1);
    EXPECT_NEAR(a.offsets.bias, 0.25, 0.01);
    EXPECT_NEAR(a.offsets.rms, 0.25, 0.01);
    EXPECT_NEAR(a.offsets.most, 0.25, 0.02);
    EXPECT_NEAR(a.offsets.robust, 1.4826 * 0.25, 0.02);
    EXPECT_NEAR(against(drawing({circle(19.75)}), drawing({circle(20)})).offsets.bias, -0.25, 0.01);
}

TEST(Accuracy, TellsHowMuchIsDrawnAndHowMuchOfItIsTrue) {
    const Accuracy a = against(drawing({line(10, 10, 70, 10)}), drawing({line(30, 10, 110, 10)}));
    EXPECT_NEAR(a.precision, 40.0 / 60, 0.02);
    EXPECT_NEAR(a.recall, 40.0 / 70, 0.02) << "at 100 the view ends";
    ASSERT_THAT(a.extra.strokes, SizeIs(1));
    EXPECT_NEAR(length_of(a.extra.strokes[0]), 20, 1.1);
    ASSERT_THAT(a.missed.strokes, SizeIs(1));
    EXPECT_NEAR(a.missed.strokes[0].vertices.front().x, 70, 1);
}

TEST(Accuracy, DoesNotDependOnHowManyVerticesLinesHave) {
    Places close;
    for (int i = 0; i <= 800; ++i) close.emplace_back(10 + 0.1 * i, 20 + 0.02 * i);
    const Strokes fine = drawing({stroke(close)}), coarse = drawing({line(10, 20, 90, 36)});
    for (const auto& [drawn, truth] : {std::pair(fine, coarse), std::pair(coarse, fine)}) {
        EXPECT_EQ(against(drawn, truth).precision, 1);
        EXPECT_EQ(against(drawn, truth).recall, 1);
    }
}

TEST(Accuracy, IsToldByKind) {
    const Accuracy a = against(
        drawing({line(10, 10, 90, 10), line(10, 30, 90, 30, StrokeKind::kCrease)}),
        drawing({line(10, 10, 90, 10, StrokeKind::kFold), line(10, 50, 30, 50, StrokeKind::kCrease)}));
    ASSERT_THAT(a.drawn, SizeIs(2));
    EXPECT_EQ(a.drawn[0].kind, StrokeKind::kOutline);
    EXPECT_NEAR(a.drawn[0].matched, 80, 1e-9);
    EXPECT_EQ(a.drawn[1].matched, 0);
    ASSERT_THAT(a.truth, SizeIs(2));
    EXPECT_EQ(a.truth[0].kind, StrokeKind::kFold);
    EXPECT_NEAR(a.truth[0].matched, 80, 1e-9);
    EXPECT_NEAR(a.truth[1].length, 20, 1e-9);
    EXPECT_EQ(a.truth[1].matched, 0);
}

TEST(Accuracy, ALineDrawnTwiceIsTrueOnce) {
    const Strokes truth = drawing({line(10, 10, 90, 10)});
    EXPECT_NEAR(against(drawing({line(10, 10.2, 90, 10.2), line(10, 9.5, 90, 9.5)}), truth).precision, 0.5,
                0.01);
    // …but where the truth has it twice, as Line Art draws an edge that is a contour and a crease.
    const Strokes twice = drawing({line(10, 10, 90, 10), line(10, 10, 90, 10, StrokeKind::kCrease)});
    EXPECT_EQ(against(truth, twice).recall, 1);
}

TEST(Accuracy, WhatIsTooFarOrTurnsAwayIsNotTheLine) {
    const Strokes truth = drawing({line(10, 50, 90, 50)});
    EXPECT_EQ(against(drawing({line(10, 51.1, 90, 51.1)}), truth).precision, 0);
    EXPECT_EQ(against(drawing({line(90, 50.9, 10, 50.9)}), truth).precision, 1)
        << "backwards is the same line";
    EXPECT_EQ(against(drawing({line(50, 10, 50, 90)}), truth).precision, 0);
    EXPECT_EQ(accuracy_of(drawing({line(10, 51.1, 90, 51.1)}), truth, {.within = 1.2}).precision, 1);
}

TEST(Accuracy, TheTruthIsLaidOverTheDrawing) {
    const Strokes small = strokes_in({0, 0, 50, 50}, {line(5, 5, 45, 25)});
    const Accuracy a = against(drawing({line(10, 10, 90, 50)}), small);
    EXPECT_EQ(a.precision, 1);
    EXPECT_EQ(a.recall, 1);
    EXPECT_NEAR(a.offsets.rms, 0, 1e-9);
}

TEST(Form, OfACircleIsEvenAndClosed) {
    Strokes of = drawing({circle(20, 3)});
    of.strokes[0].near = 7;
    const Form f = form_of(of);
    EXPECT_NEAR(f.length, 2 * std::numbers::pi * 20, 0.2);
    EXPECT_EQ(f.ends, 0U);
    EXPECT_EQ(f.objects, 1U);
    EXPECT_EQ(f.closed, 1U);
    EXPECT_EQ(f.doubles, 0);
    EXPECT_LT(f.ripple, 0.01);
    EXPECT_EQ(f.width_slope, 0);
    EXPECT_LE(f.curves, 8U);
}

TEST(Form, OfWhatGoesFarOutOfThePictureCountsWhatIsNear) {
    const double far = 1e12;
    EXPECT_NEAR(form_of(drawing({line(50, 50, far, 50)})).length, 66, 1);
    EXPECT_NEAR(form_of(drawing({line(-far, 50, far, 50)})).length, 132, 1);
    EXPECT_EQ(form_of(drawing({line(far, 10, far, 90)})).length, 0);
}

TEST(Form, CountsEndsThatMeetNothing) {
    const Form f = form_of(drawing({line(10, 10, 90, 10), line(50, 11, 50, 60), line(50, 80, 100, 80)}));
    EXPECT_EQ(f.ends, 6U);
    EXPECT_EQ(f.loose_ends, 4U) << "one meets a line, one the rim";
    EXPECT_NEAR(f.loose_per_thousand(), 4 / 0.179, 0.1);
}

TEST(Form, AnOutlineWithAGapIsNotClosed) {
    Strokes of = drawing({line(20, 20, 60, 20), line(60, 20, 60, 60), line(60, 60, 24, 20)});
    for (Stroke& s : of.strokes) s.near = 7;
    EXPECT_EQ(form_of(of).closed, 0U);
    of.strokes[2].vertices.back().x = 20.5;
    EXPECT_EQ(form_of(of).closed, 1U);
    of.strokes[0].vertices.front().x = 1;
    EXPECT_EQ(form_of(of).objects, 0U) << "it may go on outside";
}

TEST(Form, DoublesRunAlongALineBeforeThem) {
    EXPECT_NEAR(form_of(drawing({line(10, 10, 90, 10), line(10, 11, 50, 11)})).doubles, 40.0 / 120, 0.02);
    EXPECT_EQ(form_of(drawing({line(10, 10, 90, 10), line(50, 11, 10, 11)})).doubles, 0)
        << "both sides of a wire";
    EXPECT_EQ(form_of(drawing({line(10, 10, 90, 10), line(10, 12, 50, 12)})).doubles, 0);
}

TEST(Form, RippleIsWhatShakesWithinSixPixels) {
    Places shaky, calm;
    for (int i = 0; i < 80; ++i) {
        shaky.emplace_back(10 + i, 50 + (i % 2 == 0 ? 0.2 : -0.2));
        calm.emplace_back(10 + i, 50 + 5 * std::sin(i / 12.0));
    }
    EXPECT_NEAR(form_of(drawing({stroke(shaky)})).ripple, 0.2 / std::sqrt(3.0), 0.02) << "a zigzag";
    EXPECT_LT(form_of(drawing({stroke(calm)})).ripple, 0.01);
}

TEST(Form, WidthIsJudgedAwayFromItsTips) {
    Stroke wedge = stroke({{5, 50}, {30, 50}, {70, 50}, {95, 50}}, 2);
    wedge.vertices[0].width = wedge.vertices[3].width = 0;
    const Form even = form_of(drawing({wedge}));
    EXPECT_NEAR(even.width_slope, 0, 1e-9);
    wedge.vertices[2].width = 6;
    const Form f = form_of(drawing({wedge}));
    EXPECT_NEAR(f.width_slope, 0.1, 1e-6);
    EXPECT_NEAR(f.width_spread, 0.05, 0.02);
}

// Everything moves by (x, y) a frame, y down.
MotionPass moving(float x, float y) {
    const auto all = [](float v) { return std::vector<float>(static_cast<std::size_t>(kFrame.area()), v); };
    return {kFrame, {all(-x), all(y), all(-x), all(y)}, {}};
}

Stroke moved(Stroke s, double x, double y) {
    for (StrokeVertex& v : s.vertices) {
        v.x += x;
        v.y += y;
    }
    return s;
}

// Three frames of a scene that moves right and up.
std::vector<MovingFrame> film(const Stroke& first, const Stroke& second, const Stroke& third) {
    std::vector<MovingFrame> out;
    double frame = 0;
    for (const Stroke& s : {first, second, third}) {
        out.push_back({drawing({moved(s, 1.5 * frame, -frame)}), moving(1.5F, -1)});
        ++frame;
    }
    return out;
}

Steadiness steadiness(const std::vector<MovingFrame>& frames) { return steadiness_of(frames, {}); }

TEST(Motion, LinesThatGoWithTheirSurfacesAreSteady) {
    const Steadiness s = steadiness(film(circle(20), circle(20), circle(20)));
    EXPECT_EQ(s.pairs, 2U);
    EXPECT_NEAR(s.length, 4 * 2 * std::numbers::pi * 20, 2);
    EXPECT_NEAR(s.swim.rms, 0, 0.01);
    EXPECT_EQ(s.pops, 0);
    EXPECT_EQ(s.lost_ink, 0);
    EXPECT_NEAR(s.shot_drift, 0, 0.01);
    EXPECT_NEAR(s.drifted, 2 * std::numbers::pi * 20, 1);
}

TEST(Motion, SwimAndDriftAreAcrossTheLine) {
    const Steadiness s = steadiness(film(circle(20), circle(20.2), circle(20.4)));
    EXPECT_NEAR(s.swim.rms, 0.2, 0.01);
    EXPECT_NEAR(s.drift, 0.2, 0.01);
    EXPECT_NEAR(s.shot_drift, 0.4, 0.02);
    EXPECT_EQ(s.pops, 0);
}

TEST(Motion, WhatBlinksIsLostInkByItsWidth) {
    std::vector<MovingFrame> frames;
    for (const bool seen : {true, false, true}) {
        std::vector<Stroke> strokes{stroke({{10, 30}, {90, 30}}, 3)};
        if (seen) strokes.push_back(stroke({{10, 60}, {50, 60}}, 1));
        if (!seen) strokes.push_back(stroke({{10, 80}, {12, 80}}, 1));
        frames.push_back({drawing(strokes), moving(0, 0)});
    }
    const Steadiness s = steadiness(frames);
    EXPECT_NEAR(s.length, 4 * 80 + 2 * 40 + 2 * 2, 1e-6);
    EXPECT_NEAR(s.pops, 80 / s.length, 1e-6);
    EXPECT_NEAR(s.flecks, 4 / s.length, 1e-6);
    EXPECT_NEAR(s.lost_ink, 84.0 / (3 * 320 + 84), 1e-6);
}

TEST(Motion, WhatLeavesTheViewOrIsCoveredDoesNotCount) {
    std::vector<MovingFrame> frames = film(line(10, 50, 90, 50), line(10, 50, 90, 50), line(10, 50, 90, 50));
    frames[1].drawing.strokes.clear();
    // On the right half of the next frames there is something that came from elsewhere.
    for (const std::size_t f : {1U, 2U})
        for (std::size_t i = 0; i < frames[f].motion.vector[0].size(); ++i)
            if (i % 100 >= 50) frames[f].motion.vector[0][i] = 9;
    const Steadiness s = steadiness({frames[0], frames[1]});
    EXPECT_NEAR(s.length, 50 - 10 - 1.5, 1);
    EXPECT_EQ(s.pops, 1);
}

TEST(Motion, IsThatOfTheNearerSide) {
    // Above the line something far moves otherwise; the line, which runs left, has it on its right.
    MotionPass still = moving(0, 0);
    still.depth.assign(still.vector[0].size(), 2);
    for (std::size_t i = 0; i < 5000; ++i) {
        still.depth[i] = 9;
        for (std::vector<float>& channel : still.vector) channel[i] = 3;
    }
    const std::vector<MovingFrame> frames(2, {drawing({line(90, 50, 10, 50)}), still});
    EXPECT_NEAR(steadiness(frames).length, 160, 1);
    EXPECT_EQ(steadiness(frames).swim.rms, 0);
}

TEST(Motion, OfSomethingThinIsThatUnderItsMiddle) {
    // A wire that comes down by 3 pixels a frame and shows in each fourth pixel, before what stands still.
    std::vector<MovingFrame> frames;
    for (const int y : {40, 43, 46}) {
        MotionPass motion = moving(0, 0);
        motion.depth.assign(motion.vector[0].size(), 9);
        for (std::size_t x = 0; x < 100; x += 4) {
            const std::size_t i = static_cast<std::size_t>(y) * 100 + x;
            motion.depth[i] = 2;
            motion.vector[1][i] = motion.vector[3][i] = 3;
        }
        Stroke wire = line(10, y + 0.5, 90, y + 0.5);
        wire.kind = StrokeKind::kRidge;
        for (StrokeVertex& v : wire.vertices) v.thickness = 0.3;
        frames.push_back({drawing({wire}), motion});
    }
    const Steadiness s = steadiness(frames);
    EXPECT_NEAR(s.length, 4 * 80, 1);
    EXPECT_EQ(s.pops, 0);
    EXPECT_EQ(s.swim.rms, 0);
    EXPECT_NEAR(s.drifted, 80, 1);
    for (MovingFrame& f : frames) f.drawing.strokes[0].vertices = line(10, 40.5, 90, 40.5).vertices;
    EXPECT_EQ(steadiness(frames).pops, 0) << "a crest goes with what is beside it";
}

}  // namespace
}  // namespace keyline::testing
