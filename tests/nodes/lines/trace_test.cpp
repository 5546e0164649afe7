// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/strokes.h"
#include "engine/node/datum.h"
#include "engine/plan/planner.h"
#include "tests/support/run.h"
#include "tests/support/scene.h"

#include <cmath>
#include <functional>
#include <gmock/gmock.h>
#include <numbers>
#include <random>

namespace keyline::testing {
namespace {

using ::testing::HasSubstr;

constexpr int kSize = 48;

// The strokes of node `id`.
Strokes strokes_in(const Json& nodes, const std::string& id, const Sequences& inputs) {
    render(make_plan(resolve_graph(nodes, {}, inputs, 1, true, {id}), {2, 16}));
    return datum_as<Strokes>(*rendered_data().front());
}

Strokes trace(const Image& in, Json params) {
    params.set("type", "trace").set("in", "in");
    return strokes_in({{"t", params}}, "t", {{"in", {in}}});
}

using Field = std::function<double(double x, double y)>;

Image sampled(const Field& f) {
    Image image(Rect{0, 0, kSize, kSize}, {"Y"});
    return image.fill("Y", [&](int x, int y) { return f(x + 0.5, y + 0.5); });
}

// How far the vertices are from a line given by its distance function, but for those near the rim.
double rms(const Strokes& strokes, const Field& distance) {
    double sum = 0;
    int n = 0;
    for (const Stroke& s : strokes.strokes)
        for (const StrokeVertex& v : s.vertices)
            if (std::min({v.x, v.y, kSize - v.x, kSize - v.y}) > 4) {
                sum += distance(v.x, v.y) * distance(v.x, v.y);
                ++n;
            }
    return std::sqrt(sum / n);
}

// From a line through the picture's middle.
Field across(double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    return [x = std::cos(angle), y = std::sin(angle)](double u, double v) {
        return (u - 24.2) * x + (v - 23.9) * y;
    };
}

double around(double x, double y) { return std::hypot(x - 24.3, y - 23.6) - 12; }

TEST(Trace, LevelsAreClosedAroundWhatReachesThem) {
    const Strokes strokes = trace(sampled([](double x, double y) { return 5 - around(x, y); }),
                                  {{"mode", "level"}, {"level", 5}, {"sigma", 0.5}, {"kind", "light"}});
    ASSERT_EQ(strokes.strokes.size(), 1U);
    EXPECT_TRUE(strokes.strokes[0].closed);
    EXPECT_EQ(strokes.strokes[0].kind, StrokeKind::kLight);
    EXPECT_LT(rms(strokes, around), 0.02);
    double curvature = 0;
    for (const StrokeVertex& v : strokes.strokes[0].vertices)
        curvature += v.curvature / static_cast<double>(strokes.strokes[0].vertices.size());
    EXPECT_NEAR(curvature, 1.0 / 12, 0.005) << "clockwise: what reaches it is on the right";
}

TEST(Trace, EdgesAreWhereTheSlopeIsLargest) {
    for (const double degrees : {0.0, 11.0, 30.0, 45.0, 71.0, 90.0}) {
        const Field line = across(degrees);
        const auto edge = [&](double x, double y) { return 1 / (1 + std::exp(-2 * line(x, y))); };
        const Strokes strokes = trace(sampled(edge), {{"low", 0.05}});
        ASSERT_EQ(strokes.strokes.size(), 1U) << degrees;
        EXPECT_LT(rms(strokes, line), 0.05) << degrees;
        EXPECT_GT(length_of(strokes.strokes[0]), 40) << degrees;
        const StrokeVertex &a = strokes.strokes[0].vertices.front(), &b = strokes.strokes[0].vertices.back();
        const double x = (a.x + b.x) / 2 - (b.y - a.y) / 20, y = (a.y + b.y) / 2 + (b.x - a.x) / 20;
        EXPECT_GT(line(x, y), 0.5) << "the larger values are on the right";
    }
}

TEST(Trace, EdgesGoRound) {
    const Strokes strokes = trace(
        sampled([](double x, double y) { return 1 / (1 + std::exp(2 * around(x, y))); }), {{"low", 0.05}});
    ASSERT_EQ(strokes.strokes.size(), 1U);
    EXPECT_TRUE(strokes.strokes[0].closed);
    EXPECT_LT(rms(strokes, around), 0.08);
}

TEST(Trace, TakesAGradientAsItIs) {
    const Field line = across(30);
    const Json nodes{{"g", {{"type", "gradient"}, {"in", "in"}}},
                     {"t", {{"type", "trace"}, {"in", "g"}, {"low", 0.2}}}};
    const Image in = sampled([&](double x, double y) { return 1 / (1 + std::exp(-2 * line(x, y))); });
    const Strokes strokes = strokes_in(nodes, "t", {{"in", {in}}});
    ASSERT_EQ(strokes.strokes.size(), 1U);
    EXPECT_LT(rms(strokes, line), 0.05);
}

// The slope of several channels at once has no side that is higher: either sign of it is as good.
TEST(Trace, AGradientOfSeveralChannelsMakesOneLine) {
    const Image slope = Image(Rect{0, 0, kSize, kSize}, {"dx", "dy", "magnitude"})
                            .fill("dx",
                                  [](int x, int y) {
                                      const double far = x - 20.3 - 0.1 * y;
                                      return (y / 3 % 2 == 0 ? 1 : -1) * std::exp(-far * far / 4);
                                  })
                            .fill("magnitude", [](int x, int y) {
                                const double far = x - 20.3 - 0.1 * y;
                                return std::exp(-far * far / 4);
                            });
    const Strokes strokes = trace(slope, {{"low", 0.1}, {"high", 0.5}});
    ASSERT_EQ(strokes.strokes.size(), 1U);
    EXPECT_NEAR(length_of(strokes.strokes[0]), 46, 2);
}

TEST(Trace, RidgesAndValleysAreOnTheCrest) {
    for (const double degrees : {0.0, 20.0, 45.0, 80.0}) {
        const Field line = across(degrees);
        for (const bool ridge : {true, false}) {
            const auto bump = [&](double x, double y) {
                return (ridge ? 1 : -1) * std::exp(-line(x, y) * line(x, y) / 4);
            };
            const Strokes strokes =
                trace(sampled(bump), {{"mode", ridge ? "ridge" : "valley"}, {"low", 0.05}});
            ASSERT_EQ(strokes.strokes.size(), 1U) << degrees;
            EXPECT_LT(rms(strokes, line), 0.03) << degrees;
        }
    }
}

// What is thinner than a pixel has no outlines, but a middle.
TEST(Trace, ThinThingsAreRidgesOfTheirCoverage) {
    const Point from{6.3, 10.1}, to{41.2, 30.4};
    const double length = std::hypot(to.x - from.x, to.y - from.y);
    const Point way{(to.x - from.x) / length, (to.y - from.y) / length};
    for (const double width : {0.3, 0.6, 0.9}) {
        const Scene scene{.things = {wire("hair", from, to, width, 5), disc("a", {30, 20}, 15, 9)}};
        const Json nodes{
            {"thin",
             {{"type", "cryptomatte"}, {"in", "in"}, {"layer", "CryptoObject"}, {"objects", {"hair"}}}},
            {"middle",
             {{"type", "trace"},
              {"in", "thin"},
              {"mode", "ridge"},
              {"sigma", 0.8},
              {"low", 0.01},
              {"high", 0.1}}},
            {"whole", {{"type", "chain"}, {"in", {"middle"}}, {"gap", 6}, {"min_length", 6}}}};
        const Strokes strokes = strokes_in(nodes, "whole", {{"in", {passes_of(scene)}}});
        ASSERT_EQ(strokes.strokes.size(), 1U) << width;
        const std::vector<StrokeVertex>& vertices = strokes.strokes[0].vertices;
        double squares = 0, least = length, most = 0;
        int count = 0;
        for (const StrokeVertex& v : vertices) {
            const double x = v.x - from.x, y = v.y - from.y, along = x * way.x + y * way.y,
                         across = y * way.x - x * way.y;
            least = std::min(least, along);
            most = std::max(most, along);
            if (along < 2 || along > length - 2) continue;
            squares += across * across;
            ++count;
        }
        EXPECT_LT(std::sqrt(squares / count), 0.05) << width;
        EXPECT_NEAR(least, 0, 1.5) << width;
        EXPECT_NEAR(most, length, 1.5) << width;
    }
}

// An edge that loses its contrast from left to right.
Image fading() {
    return sampled([](double x, double y) { return (1 - x / kSize) / (1 + std::exp(-2 * (y - 24.2))); });
}

TEST(Trace, LinesThatFadeGrowThin) {
    const Strokes strokes = trace(fading(), {{"low", 0.05}, {"high", 0.2}});
    ASSERT_EQ(strokes.strokes.size(), 1U);
    const auto& vertices = strokes.strokes[0].vertices;
    const auto [thin, thick] = std::ranges::minmax_element(vertices, {}, &StrokeVertex::width);
    EXPECT_GT(thick->width, 0.9);
    EXPECT_LT(thin->width, 0.1);
    EXPECT_LT(thick->x, thin->x);
    const Strokes hard = trace(fading(), {{"low", 0.05}, {"soft", false}});
    for (const StrokeVertex& v : hard.strokes.at(0).vertices) EXPECT_EQ(v.width, 1);
}

TEST(Trace, ALineHasAPointThatReachesHigh) {
    EXPECT_EQ(trace(fading(), {{"low", 0.05}, {"high", 0.9}}).strokes.size(), 0U);
}

TEST(Trace, WhatHasAStrokeAlreadyIsLeftOut) {
    const Scene scene{.things = {disc("a", {24.2, 23.9}, 12, 5)}};
    const Json nodes{
        {"outline", {{"type", "contours"}, {"in", "in"}, {"layer", "CryptoObject"}}},
        {"edge", {{"type", "trace"}, {"in", "in:CryptoObject00.g"}, {"low", 0.1}}},
        {"rest", {{"type", "trace"}, {"in", "in:CryptoObject00.g"}, {"low", 0.1}, {"except", "outline"}}}};
    const Sequences passes{{"in", {passes_of(scene)}}};
    EXPECT_EQ(strokes_in(nodes, "edge", passes).strokes.size(), 1U);
    EXPECT_EQ(strokes_in(nodes, "rest", passes).strokes.size(), 0U);
}

TEST(Trace, LinesBelongToTheObjectThatTheyAreOn) {
    Image ids(Rect{0, 0, kSize, kSize}, {"Y"});
    ids.fill("Y", [](int x, int) { return x < 20 ? 3 : 7; });
    const Json nodes{{"t", {{"type", "trace"}, {"in", "in"}, {"owner", "ids"}, {"low", 0.05}}}};
    const auto edge = sampled([](double, double y) { return 1 / (1 + std::exp(-2 * (y - 24.2))); });
    const Strokes strokes = strokes_in(nodes, "t", {{"in", {edge}}, {"ids", {ids}}});
    ASSERT_EQ(strokes.strokes.size(), 2U);
    EXPECT_EQ(strokes.strokes[0].near, std::bit_cast<uint32_t>(3.0F));
    EXPECT_EQ(strokes.strokes[1].near, std::bit_cast<uint32_t>(7.0F));
}

TEST(Trace, MirroredPicturesHaveMirroredStrokes) {
    const Field line = across(23);
    const auto edge = [&](double x, double y) { return std::sin(line(x, y) / 3) + around(x, y) / 20; };
    const Strokes plain = trace(sampled(edge), {{"low", 0.05}, {"high", 0.06}});
    const Strokes mirrored = trace(sampled([&](double x, double y) { return edge(kSize - x, y); }),
                                   {{"low", 0.05}, {"high", 0.06}});
    ASSERT_EQ(plain.strokes.size(), mirrored.strokes.size());
    std::vector<double> a, b;
    for (const Stroke& s : plain.strokes) a.push_back(length_of(s));
    for (const Stroke& s : mirrored.strokes) b.push_back(length_of(s));
    std::ranges::sort(a);
    std::ranges::sort(b);
    EXPECT_THAT(a, ::testing::Pointwise(::testing::DoubleNear(1e-3), b));
}

TEST(Trace, TellsWhatDoesNotFit) {
    const Image in = ascii({"12"});
    EXPECT_THAT(error_of("trace", {{"mode", "level"}}, in), HasSubstr("'level' is missing"));
    EXPECT_THAT(error_of("trace", {{"level", 2}}, in), HasSubstr("is for the mode 'level'"));
    EXPECT_THAT(error_of("trace", {{"sigma", 2}}, in), HasSubstr("'low' is missing"));
    EXPECT_THAT(error_of("trace", {{"mode", "level"}, {"level", 2}, {"low", 1}}, in),
                HasSubstr("no thresholds"));
    EXPECT_THAT(error_of("trace", {{"low", 2}, {"high", 1}}, in), HasSubstr("must not be above"));
    EXPECT_THAT(error_of("trace", {{"mode", "level"}, {"level", 2}, {"owner", "in"}}, in),
                HasSubstr("no owner"));
}

// As a renderer averages them: of so many places in a pixel, evenly or at random.
void average_normals(Image& passes, const Scene& scene, int samples, bool at_random) {
    std::mt19937 random;
    std::uniform_real_distribution<double> somewhere(0, 1);
    const std::array axes{&Vec3::x, &Vec3::y, &Vec3::z};
    const std::array names{"Normal.X", "Normal.Y", "Normal.Z"};
    std::array<Image, 3> means{passes, passes, passes};
    for (int y = scene.window.y0; y < scene.window.y1; ++y)
        for (int x = scene.window.x0; x < scene.window.x1; ++x) {
            Vec3 sum;
            for (int i = 0; i < samples * samples; ++i) {
                const double u = at_random ? somewhere(random) : (i % samples + 0.5) / samples,
                             v = at_random ? somewhere(random) : (i / samples + 0.5) / samples;
                const Vec3 n = front_of(scene, {x + u, y + v}).hit.normal;
                sum = {sum.x + n.x, sum.y + n.y, sum.z + n.z};
            }
            for (std::size_t c = 0; c < 3; ++c)
                means[c].at(names[c], x, y) = static_cast<float>(sum.*axes[c] / (samples * samples));
        }
    for (std::size_t c = 0; c < 3; ++c)
        passes.fill(names[c], [&](int x, int y) { return means[c].at(names[c], x, y); });
}

// How far the fold of what stands before something else is from where it is.
double fold_rms(const Scene& scene, bool by_normals, double least_length, int samples,
                bool at_random = false) {
    Image passes = passes_of(scene);
    average_normals(passes, scene, samples, at_random);
    Json folds{{"type", "trace"}, {"in", "steps"}, {"low", 0.02}, {"high", 0.05}, {"kind", "fold"}};
    if (by_normals) folds.set("normal", "in:Normal");
    const Strokes strokes =
        strokes_in({{"steps", {{"type", "planestep"}, {"in", "in:Depth"}}}, {"folds", folds}}, "folds",
                   {{"in", {passes}}});
    const std::vector<TruePoint> truth = lines_of(scene);
    double sum = 0, length = 0;
    int n = 0;
    for (const Stroke& s : strokes.strokes) {
        length += length_of(s);
        for (const StrokeVertex& v : s.vertices) {
            sum += std::pow(offset_from(truth, {v.x, v.y}), 2);
            ++n;
        }
    }
    EXPECT_GT(length, least_length);
    return std::sqrt(sum / n);
}

TEST(Trace, FoldsArePlacedByAveragedNormals) {
    const Camera camera;
    const Thing wall = polygon("wall", {{-9, -9}, {60, -9}, {60, 60}, {-9, 60}}, 9);
    for (const double radius : {0.9, 1.5}) {
        const Scene scene{.things = {wall, sphere("ball", camera, {0.13, -0.08, 5}, radius)}};
        const double length = 0.7 * 2 * std::numbers::pi * camera.focal * radius / 5;
        const double at_centres = fold_rms(scene, false, length, 8),
                     placed = fold_rms(scene, true, length, 8),
                     noisy = fold_rms(scene, true, length, 4, true);
        EXPECT_GT(at_centres, 0.2) << radius;
        EXPECT_LT(placed, 0.06) << radius;
        EXPECT_LT(noisy, 0.13) << radius;
    }
}

TEST(Trace, OnlyEdgesArePlacedByNormals) {
    EXPECT_THAT(error_of("trace", {{"mode", "ridge"}, {"low", 0.1}, {"normal", "in"}}, ascii({"1"})),
                HasSubstr("'normal' places edges"));
}

}  // namespace
}  // namespace keyline::testing
