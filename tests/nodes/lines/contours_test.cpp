// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/cryptomatte.h"
#include "engine/kit/strokes.h"
#include "engine/node/datum.h"
#include "engine/plan/planner.h"
#include "tests/support/run.h"
#include "tests/support/scene.h"

#include <cmath>
#include <gmock/gmock.h>
#include <numbers>
#include <set>

namespace keyline::testing {
namespace {

using ::testing::ElementsAre;

using Images = std::map<std::string, Image>;

const Vec3 kBall{0.1, 0, 6};
constexpr double kBallRadius = 1.2, kGround = 1;

Scene ball_in_the_ground() {
    const Camera camera;
    return {.things = {ground("ground", camera, kGround), sphere("ball", camera, kBall, kBallRadius)},
            .contacts = {contact(camera, kBall, kBallRadius, kGround)}};
}

Scene two_discs() {
    return {.things = {disc("behind", {18.2, 23.7}, 10, 5), disc("before", {30.4, 22.1}, 9, 4)}};
}

// A half-plane that ends a little off the middle of the picture.
Scene edge_at(double degrees) {
    const double angle = degrees * std::numbers::pi / 180, x = std::cos(angle), y = std::sin(angle);
    const Point p{24 + 0.7 * x, 24.3 - 0.2 * y};
    const auto corner = [&](double along, double across) {
        return Point{p.x + 90 * (along * x - across * y), p.y + 90 * (along * y + across * x)};
    };
    return {.things = {polygon("a", {corner(-1, 0), corner(1, 0), corner(1, 1), corner(-1, 1)}, 5)}};
}

Strokes strokes_in(const Images& inputs, Json params = {}, const RunOptions& options = {}) {
    params.set("type", "contours").set("in", "in");
    Sequences sequences;
    for (const auto& [name, image] : inputs) sequences[name] = {image};
    render(make_plan(resolve_graph({{"c", params}}, {}, sequences, 1, true, {"c"}),
                     {options.threads, options.tile, options.memory}));
    return datum_as<Strokes>(*rendered_data().front());
}

Strokes strokes_in(const Image& passes, const RunOptions& options = {}) {
    return strokes_in(Images{{"in", passes}}, {{"layer", "CryptoObject"}, {"depth", "in:Depth"}}, options);
}

Strokes strokes_of(const Scene& scene, int samples = 0) { return strokes_in(passes_of(scene, samples)); }

std::vector<StrokeVertex> vertices_of(const Strokes& strokes) {
    std::vector<StrokeVertex> out;
    for (const Stroke& s : strokes.strokes) out.insert(out.end(), s.vertices.begin(), s.vertices.end());
    return out;
}

// How far the vertices are from the true lines: the mean, and the root of the mean square.
struct Offsets {
    double bias = 0, rms = 0, most = 0;
};
Offsets offsets(const Strokes& strokes, const std::vector<TruePoint>& truth, double margin = 0) {
    double sum = 0, squares = 0, most = 0;
    int n = 0;
    for (const StrokeVertex& v : vertices_of(strokes)) {
        if (std::min({v.x, v.y, 48 - v.x, 48 - v.y}) < margin) continue;
        const double d = offset_from(truth, {v.x, v.y});
        sum += d;
        squares += d * d;
        most = std::max(most, std::fabs(d));
        ++n;
    }
    return {sum / n, std::sqrt(squares / n), most};
}

Offsets offsets(const Scene& scene, int samples) {
    return offsets(strokes_of(scene, samples), lines_of(scene), 3);
}

double length_of(const Strokes& strokes) {
    double sum = 0;
    for (const Stroke& s : strokes.strokes) sum += keyline::length_of(s);
    return sum;
}

uint32_t id(const char* name) { return cryptomatte_id(name); }

TEST(Contours, StraightEdgesAreWithinAHundredthOfAPixel) {
    double squares = 0;
    for (int degrees = 0; degrees < 90; degrees += 15) {
        const Offsets exact = offsets(edge_at(degrees), 0);
        EXPECT_LT(exact.most, 0.03) << degrees << ": at most where the edge runs along the pixels";
        squares += exact.rms * exact.rms / 6;
        EXPECT_LT(offsets(edge_at(degrees), 64).rms, 0.05) << degrees;
    }
    EXPECT_LT(std::sqrt(squares), 0.014);
}

TEST(Contours, CirclesAreNotShrunkByTheBlur) {
    for (const double radius : {5.0, 12.0}) {
        const Scene scene{.things = {disc("a", {24.23, 23.71}, radius, 5)}};
        const Offsets exact = offsets(scene, 0), sampled = offsets(scene, 64);
        EXPECT_LT(std::fabs(exact.bias), 0.01) << radius;
        EXPECT_LT(exact.rms, 0.02) << radius;
        EXPECT_LT(std::fabs(sampled.bias), 0.02) << radius;
        EXPECT_LT(sampled.rms, 0.06) << radius;
    }
}

TEST(Contours, AnOutlineIsOneClosedStrokeAroundItsObject) {
    const Strokes strokes = strokes_of({.things = {disc("a", {24.23, 23.71}, 10, 5)}});
    ASSERT_EQ(strokes.strokes.size(), 1U);
    const Stroke& s = strokes.strokes[0];
    EXPECT_TRUE(s.closed);
    EXPECT_EQ(s.kind, StrokeKind::kOutline);
    EXPECT_EQ(s.near, id("a"));
    EXPECT_EQ(s.far, 0U);
    EXPECT_EQ(strokes.names.at(s.near), "a");
    double curvature = 0;
    for (const StrokeVertex& v : s.vertices) {
        curvature += v.curvature / static_cast<double>(s.vertices.size());
        EXPECT_NEAR(v.depth, 5, 1e-5);
    }
    EXPECT_NEAR(curvature, 0.1, 0.005) << "clockwise: the object is on the right";
    EXPECT_NEAR(keyline::length_of(s), 20 * std::numbers::pi, 0.2);
}

TEST(Contours, AreCalledAsIsAskedFor) {
    const Images passes{{"in", passes_of(ball_in_the_ground())}};
    const Json depth{{"layer", "CryptoObject"}, {"depth", "in:Depth"}};
    Json named = depth;
    named.set("kind", "material");
    Strokes expected = strokes_in(passes, depth);
    EXPECT_GT(expected.strokes.size(), 1U);
    for (Stroke& s : expected.strokes) s.kind = StrokeKind::kMaterial;
    arrange(expected);
    EXPECT_EQ(strokes_in(passes, named), expected);
}

TEST(Contours, EveryBorderComesOnce) {
    const Scene scene = two_discs();
    const Strokes strokes = strokes_of(scene);
    const std::vector<TruePoint> truth = lines_of(scene);
    double length = 0;
    for (const TruePoint& p : truth) length += p.length;
    EXPECT_NEAR(length_of(strokes), length, 1);
    EXPECT_LT(offsets(strokes, truth).most, 0.1);
    const std::vector<StrokeVertex> vertices = vertices_of(strokes);
    for (std::size_t i = 0; i < truth.size(); i += 20) {
        const auto distance = [&](const StrokeVertex& v) {
            return std::hypot(v.x - truth[i].at.x, v.y - truth[i].at.y);
        };
        EXPECT_LT(distance(*std::ranges::min_element(vertices, {}, distance)), 0.8);
    }
}

// Behind the nearer object the line ends at its outline, which runs on as if there were nothing.
TEST(Contours, TheNearerLineGoesOnAtAJunction) {
    const Strokes strokes = strokes_of(two_discs());
    int behind = 0;
    for (const Stroke& s : strokes.strokes) {
        EXPECT_FALSE(s.closed);
        const bool hidden = s.near == id("behind");
        behind += hidden;
        for (const StrokeEnd end : s.ends) EXPECT_EQ(end, hidden ? StrokeEnd::kOccluded : StrokeEnd::kJoined);
        for (const StrokeVertex& v : {s.vertices.front(), s.vertices.back()})
            EXPECT_NEAR(std::hypot(v.x - 30.4, v.y - 22.1), 9, 0.05);
    }
    EXPECT_EQ(behind, 1);
    EXPECT_EQ(strokes.strokes.size(), 3U);
}

TEST(Contours, WhereObjectsMeetIsAnIntersection) {
    const Strokes strokes = strokes_of(ball_in_the_ground());
    double meets = 0, outline = 0;
    for (const Stroke& s : strokes.strokes) {
        if (s.far == 0 && s.near == id("ground")) continue;  // the horizon
        EXPECT_EQ(s.near, id("ball"));
        (s.kind == StrokeKind::kIntersection ? meets : outline) += keyline::length_of(s);
    }
    const Curve all = contact(Camera{}, kBall, kBallRadius, kGround);
    double seen = 0;
    for (const TruePoint& p : lines_of(ball_in_the_ground()))
        if (p.far_depth - p.near_depth < 0.01) seen += p.length;
    EXPECT_NEAR(meets, seen, 0.25 * seen);
    EXPECT_GT(outline, 30);
}

TEST(Contours, OfNamedObjectsAreTheLinesThatBelongToThem) {
    const Image passes = passes_of(two_discs());
    const auto owners = [&](const std::vector<Json>& objects) {
        std::set<std::string> out;
        const Strokes strokes =
            strokes_in(Images{{"in", passes}},
                       {{"layer", "CryptoObject"}, {"depth", "in:Depth"}, {"objects", Json::array(objects)}});
        for (const Stroke& s : strokes.strokes) out.insert(strokes.names.at(s.near));
        return out;
    };
    EXPECT_THAT(owners({"*"}), ElementsAre("before", "behind"));
    EXPECT_THAT(owners({"before"}), ElementsAre("before"));
    EXPECT_THAT(owners({"b*d"}), ElementsAre("behind"));
    EXPECT_THAT(owners({"be*", "before"}), ElementsAre("before", "behind"));
    const Strokes all = strokes_of(two_discs());
    for (const Stroke& s :
         strokes_in(Images{{"in", passes}},
                    {{"layer", "CryptoObject"}, {"depth", "in:Depth"}, {"objects", {"before"}}})
             .strokes)
        EXPECT_EQ(std::ranges::count(all.strokes, s), 1) << "the same strokes";
    EXPECT_THROW(owners({"befor"}), Failure);
}

TEST(Contours, WithoutDepthTheLargerIdOwnsTheLine) {
    const Strokes strokes = strokes_in(Images{{"in", passes_of(two_discs())}}, {{"layer", "CryptoObject"}});
    for (const Stroke& s : strokes.strokes) {
        EXPECT_EQ(s.kind, StrokeKind::kOutline);
        EXPECT_GT(s.near, s.far);
    }
}

TEST(Contours, TakesIdsWithoutCoverage) {
    Image ids(Rect{0, 0, 24, 24}, {"Y"});
    ids.fill("Y", [](int x, int y) { return std::hypot(x + 0.5 - 12, y + 0.5 - 12) < 7 ? 3 : 0; });
    const Strokes strokes = strokes_in(Images{{"in", ids}});
    ASSERT_EQ(strokes.strokes.size(), 1U);
    EXPECT_TRUE(strokes.strokes[0].closed);
    for (const StrokeVertex& v : strokes.strokes[0].vertices)
        EXPECT_NEAR(std::hypot(v.x - 12, v.y - 12), 7, 0.5);
}

TEST(Contours, LinesReachTheRim) {
    const Strokes strokes = strokes_of(edge_at(20));
    ASSERT_EQ(strokes.strokes.size(), 1U);
    const Stroke& s = strokes.strokes[0];
    EXPECT_EQ(s.ends, (std::array{StrokeEnd::kRim, StrokeEnd::kRim}));
    EXPECT_EQ(std::max(s.vertices.front().x, s.vertices.back().x), 48);
    EXPECT_EQ(std::min(s.vertices.front().x, s.vertices.back().x), 0);
}

TEST(Contours, ShortClosedLinesAreLeftOut) {
    const Scene scene{.things = {disc("a", {24.23, 23.71}, 1.5, 5)}};
    const Json params{{"layer", "CryptoObject"}, {"min_length", 12}};
    EXPECT_EQ(strokes_of(scene).strokes.size(), 1U);
    EXPECT_TRUE(strokes_in(Images{{"in", passes_of(scene)}}, params).strokes.empty());
}

void expect_same_places(const Strokes& a, const Strokes& b, double tolerance) {
    ASSERT_EQ(a.strokes.size(), b.strokes.size());
    for (std::size_t i = 0; i < a.strokes.size(); ++i) {
        const Stroke &s = a.strokes[i], &t = b.strokes[i];
        EXPECT_EQ(std::tie(s.kind, s.near, s.far, s.closed, s.ends),
                  std::tie(t.kind, t.near, t.far, t.closed, t.ends));
        ASSERT_EQ(s.vertices.size(), t.vertices.size());
        for (std::size_t k = 0; k < s.vertices.size(); ++k) {
            EXPECT_NEAR(s.vertices[k].x, t.vertices[k].x, tolerance);
            EXPECT_NEAR(s.vertices[k].y, t.vertices[k].y, tolerance);
        }
    }
}

TEST(Contours, MovedPicturesHaveMovedStrokes) {
    const Image passes = passes_of(ball_in_the_ground(), 16);
    Strokes moved = strokes_in(keyline::testing::moved(passes, -301, 77));
    for (Stroke& s : moved.strokes)
        for (StrokeVertex& v : s.vertices) v.x += 301, v.y -= 77;
    expect_same_places(moved, strokes_in(passes), 1e-9);
}

// Left becomes right, and the way round turns.
TEST(Contours, MirroredPicturesHaveMirroredStrokes) {
    const Image passes = passes_of(ball_in_the_ground(), 16);
    Image mirrored = passes;
    for (Image::Channel& c : mirrored.channels)
        mirrored.fill(c.name, [&](int x, int y) { return passes.at(c.name, 47 - x, y); });
    Strokes back = strokes_in(mirrored);
    for (Stroke& s : back.strokes) {
        std::ranges::reverse(s.vertices);
        std::swap(s.ends[0], s.ends[1]);
        for (StrokeVertex& v : s.vertices) v.x = 48 - v.x;
    }
    arrange(back);
    expect_same_places(back, strokes_in(passes), 1e-4);
}

TEST(Contours, TwiceTheSizeIsTheSameDrawing) {
    Scene scene = two_discs(),
          twice{.window = {0, 0, 96, 96},
                .camera = {{48, 48}, 96},
                .things = {disc("behind", {36.4, 47.4}, 20, 5), disc("before", {60.8, 44.2}, 18, 4)}};
    Strokes large = strokes_of(twice);
    for (Stroke& s : large.strokes)
        for (StrokeVertex& v : s.vertices) v.x /= 2, v.y /= 2;
    EXPECT_EQ(large.strokes.size(), strokes_of(scene).strokes.size());
    EXPECT_LT(offsets(large, lines_of(scene)).most, 0.05);
}

TEST(Contours, AreTheSameForEverySchedule) {
    const Image passes = passes_of(ball_in_the_ground(), 16);
    const Strokes whole = strokes_in(passes, {1, 4096});
    for (const int tile : {1, 7, 16})
        for (const int threads : {1, 4}) EXPECT_EQ(strokes_in(passes, {threads, tile}), whole) << tile;
}

// Through a place off the middle of the picture.
const Point kOnWire{24.3, 23.6};

Scene wire_at(double degrees, double width) {
    const double angle = degrees * std::numbers::pi / 180, x = std::cos(angle), y = std::sin(angle);
    const auto on_wire = [&](double along) { return Point{kOnWire.x + along * x, kOnWire.y + along * y}; };
    return {.things = {wire("w", on_wire(-90), on_wire(90), width, 5)}};
}

double off_wire(const StrokeVertex& v, double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    return (v.y - kOnWire.y) * std::cos(angle) - (v.x - kOnWire.x) * std::sin(angle);
}

struct WireOffsets {
    double rms = 0, thickness = 0;
};
WireOffsets wire_offsets(double degrees, double width, int samples) {
    const Strokes strokes = strokes_of(wire_at(degrees, width), samples);
    EXPECT_EQ(strokes.strokes.size(), 1U) << degrees << " degrees, " << width;
    WireOffsets out;
    int n = 0;
    for (const Stroke& s : strokes.strokes) {
        EXPECT_EQ(s.kind, StrokeKind::kRidge);
        EXPECT_EQ(s.near, id("w"));
        EXPECT_EQ(s.ends, (std::array{StrokeEnd::kRim, StrokeEnd::kRim}));
        EXPECT_GT(keyline::length_of(s), 47) << degrees << " degrees, " << width;
        for (const StrokeVertex& v : s.vertices) {
            if (std::min({v.x, v.y, 48 - v.x, 48 - v.y}) < 3) continue;
            out.rms += std::pow(off_wire(v, degrees), 2);
            out.thickness += v.thickness;
            ++n;
        }
    }
    return {std::sqrt(out.rms / n), out.thickness / n};
}

TEST(Contours, AWireIsOneStrokeAlongItsMiddle) {
    for (const double width : {0.3, 0.6, 0.9, 1.4})
        for (const double degrees : {12.0, 27.0, 45.0, 63.0, 80.0, 118.0}) {
            const WireOffsets exact = wire_offsets(degrees, width, 0),
                              sampled = wire_offsets(degrees, width, 64);
            EXPECT_LT(exact.rms, 0.05) << degrees << " degrees, " << width;
            EXPECT_NEAR(exact.thickness, width, 0.04 * width) << degrees << " degrees, " << width;
            EXPECT_LT(sampled.rms, 0.07) << degrees << " degrees, " << width;
            EXPECT_NEAR(sampled.thickness, width, 0.1 * width) << degrees << " degrees, " << width;
        }
}

// Ends have no across: they lead nowhere else than the wire does.
TEST(Contours, AWireEndsAsItRuns) {
    for (const double width : {0.6, 0.9, 1.4})
        for (const double degrees : {5.0, 27.0, 45.0, 71.0, 100.0, 150.0}) {
            const double angle = degrees * std::numbers::pi / 180, x = std::cos(angle), y = std::sin(angle);
            const Point from{kOnWire.x - 15 * x, kOnWire.y - 15 * y},
                to{kOnWire.x + 15 * x, kOnWire.y + 15 * y};
            const Strokes strokes = strokes_of(Scene{.things = {wire("w", from, to, width, 5)}});
            ASSERT_EQ(strokes.strokes.size(), 1U) << degrees << " degrees, " << width;
            const Stroke& s = strokes.strokes.front();
            EXPECT_NEAR(keyline::length_of(s), 30, 3) << degrees << " degrees, " << width;
            const std::size_t n = s.vertices.size();
            for (const std::size_t i : {std::size_t{0}, std::size_t{1}, n - 2, n - 1})
                EXPECT_LT(std::fabs(off_wire(s.vertices[i], degrees)), 0.3)
                    << degrees << " degrees, " << width;
        }
}

// As a whisker at its root: the blunt end has no outline of its own.
TEST(Contours, AThinThingsBluntEndHasNoOutline) {
    for (const double degrees : {5.0, 27.0, 45.0, 71.0, 100.0, 150.0}) {
        const double angle = degrees * std::numbers::pi / 180, x = std::cos(angle), y = std::sin(angle);
        const auto at = [&](double along, double across) {
            return Point{kOnWire.x + along * x - across * y, kOnWire.y + along * y + across * x};
        };
        const Strokes strokes = strokes_of(
            Scene{.things = {polygon("w", {at(-15, -0.5), at(15, -1), at(15, 1), at(-15, 0.5)}, 5)}});
        ASSERT_EQ(strokes.strokes.size(), 1U) << degrees << " degrees";
        EXPECT_EQ(strokes.strokes.front().kind, StrokeKind::kRidge);
        EXPECT_NEAR(keyline::length_of(strokes.strokes.front()), 30, 4.5) << degrees << " degrees";
    }
}

TEST(Contours, WhatIsNotThinHasOutlines) {
    for (const double degrees : {0.0, 27.0, 45.0}) {
        const Strokes thick = strokes_of(wire_at(degrees, 3));
        EXPECT_EQ(thick.strokes.size(), 2U) << degrees;
        for (const Stroke& s : thick.strokes) EXPECT_EQ(s.kind, StrokeKind::kOutline);
        EXPECT_LT(offsets(thick, lines_of(wire_at(degrees, 3)), 3).rms, 0.05) << degrees;
    }
    const Images thin{{"in", passes_of(wire_at(27, 1.3))}};
    for (const Stroke& s : strokes_in(thin, {{"layer", "CryptoObject"}, {"thin", 0}}).strokes)
        EXPECT_EQ(s.kind, StrokeKind::kOutline);
    EXPECT_EQ(strokes_in(thin, {{"layer", "CryptoObject"}, {"thin", 1}}).strokes.size(), 2U);
}

// From a point to 5 pixels.
Scene spike() { return {.things = {polygon("spike", {{3.3, 20.2}, {44.7, 24.1}, {44.2, 29.1}}, 5)}}; }

TEST(Contours, AMiddleGoesOverIntoTwoOutlinesOnce) {
    const Strokes strokes = strokes_of(spike());
    ASSERT_EQ(strokes.strokes.size(), 2U);
    const Stroke &outline = strokes.strokes[0], &middle = strokes.strokes[1];
    EXPECT_EQ(outline.kind, StrokeKind::kOutline);
    EXPECT_EQ(middle.kind, StrokeKind::kRidge);
    EXPECT_LT(std::min(middle.vertices.front().x, middle.vertices.back().x), 6) << "to the tip";
    const StrokeVertex& fork = std::ranges::max(middle.vertices, {}, &StrokeVertex::x);
    EXPECT_GT(fork.thickness, 1.5);
    EXPECT_LT(fork.thickness, 2.2);
    EXPECT_FALSE(outline.closed);
    for (const StrokeVertex& end : {outline.vertices.front(), outline.vertices.back()}) {
        EXPECT_EQ(end.x, fork.x);
        EXPECT_EQ(end.y, fork.y);
    }
    for (const StrokeVertex& v : outline.vertices) EXPECT_GE(v.x, fork.x);
    EXPECT_NEAR(keyline::length_of(outline) + keyline::length_of(middle),
                2 * (44.5 - fork.x) + 5 + fork.thickness + (fork.x - 3.3), 3)
        << "nothing comes twice";
}

// What is seen through it lies behind both.
TEST(Contours, AGapIsOneStrokeOfWhatIsBesideIt) {
    const Scene scene{.things = {polygon("wall", {{-9, -9}, {60, -9}, {60, 60}, {-9, 60}}, 9),
                                 polygon("left", {{-9, -9}, {22, -9}, {26, 60}, {-9, 60}}, 5),
                                 polygon("right", {{23.1, -9}, {60, -9}, {60, 60}, {27.1, 60}}, 5)}};
    const Strokes strokes = strokes_of(scene);
    ASSERT_EQ(strokes.strokes.size(), 1U);
    const Stroke& gap = strokes.strokes[0];
    EXPECT_EQ(gap.kind, StrokeKind::kOutline);
    EXPECT_EQ(gap.far, id("wall"));
    EXPECT_NE(gap.near, id("wall"));
    for (const StrokeVertex& v : gap.vertices) EXPECT_NEAR(v.x, 22.55 + (v.y + 9) * 4 / 69, 0.1);
}

// The disc is cut by the wire before it, and its outline ends on the wire.
Scene wire_before_disc() {
    return {.things = {disc("behind", {23.2, 23.7}, 10, 5), wire("w", {2.3, 30.1}, {45.8, 17.9}, 1.3, 4)}};
}

TEST(Contours, WhatEndsBehindAWireTouchesIt) {
    const Strokes strokes = strokes_of(wire_before_disc());
    const auto wire = std::ranges::find(strokes.strokes, StrokeKind::kRidge, &Stroke::kind);
    ASSERT_NE(wire, strokes.strokes.end());
    EXPECT_GT(keyline::length_of(*wire), 43);
    int ends = 0;
    for (const Stroke& s : strokes.strokes) {
        if (s.near != id("behind")) continue;
        for (const StrokeVertex& v : {s.vertices.front(), s.vertices.back()}) {
            const double x = 45.8 - 2.3, y = 17.9 - 30.1;
            EXPECT_NEAR(((v.y - 30.1) * x - (v.x - 2.3) * y) / std::hypot(x, y), 0, 0.15);
            ++ends;
        }
    }
    EXPECT_EQ(ends, 4);
}

TEST(Contours, MiddlesMoveAndTurnWithThePicture) {
    const Image passes = passes_of(wire_before_disc(), 16);
    Strokes moved = strokes_in(keyline::testing::moved(passes, -301, 77));
    for (Stroke& s : moved.strokes)
        for (StrokeVertex& v : s.vertices) v.x += 301, v.y -= 77;
    expect_same_places(moved, strokes_in(passes), 1e-9);

    Image mirrored = passes;
    for (Image::Channel& c : mirrored.channels)
        mirrored.fill(c.name, [&](int x, int y) { return passes.at(c.name, 47 - x, y); });
    Strokes back = strokes_in(mirrored);
    for (Stroke& s : back.strokes) {
        if (s.kind != StrokeKind::kRidge) {
            std::ranges::reverse(s.vertices);
            std::swap(s.ends[0], s.ends[1]);
        }
        for (StrokeVertex& v : s.vertices) v.x = 48 - v.x;
    }
    arrange(back);
    expect_same_places(back, strokes_in(passes), 1e-4);
}

TEST(Contours, MiddlesAreTheSameForEverySchedule) {
    const Image passes = passes_of(wire_before_disc(), 16);
    const Strokes whole = strokes_in(passes, {1, 4096});
    for (const int tile : {1, 7, 16})
        for (const int threads : {1, 4}) EXPECT_EQ(strokes_in(passes, {threads, tile}), whole) << tile;
}

TEST(Contours, AStepThatRunsBackwardsIsRefused) {
    EXPECT_NE(error_of("contours", {{"step", {3, 1}}}, ascii({"1"})).find("must not be below"),
              std::string::npos);
}

}  // namespace
}  // namespace keyline::testing
