// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/coverage.h"
#include "tests/support/strokes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <gmock/gmock.h>
#include <random>

namespace keyline::testing {
namespace {

constexpr Rect kFrame{-4, 3, 36, 33};

Stroke moved(Stroke s, double dx, double dy) {
    for (StrokeVertex& v : s.vertices) {
        v.x += dx;
        v.y += dy;
    }
    return s;
}

// The share of 64 × 64 samples of each pixel of a row that loops wind around, by the edges that a ray to the
// left crosses.
std::vector<double> sampled_row(const std::vector<Loop>& loops, const Rect& window, int y) {
    constexpr int kSamples = 64;
    constexpr double kStep = double(kFixedOne) / kSamples;
    std::vector<double> out(static_cast<std::size_t>(window.width()));
    for (int j = 0; j < kSamples; ++j) {
        const double at = y * kFixedOne + (j + 0.5) * kStep;
        std::vector<std::pair<double, int>> crossings;
        for (const Loop& loop : loops)
            for (std::size_t i = 0; i < loop.size(); ++i) {
                const FixedPoint &a = loop[i], &b = loop[(i + 1) % loop.size()];
                const double ay = double(a.y), by = double(b.y);
                if ((ay <= at) == (by <= at)) continue;
                crossings.emplace_back(double(a.x) + double(b.x - a.x) * (at - ay) / (by - ay),
                                       a.y < b.y ? 1 : -1);
            }
        std::ranges::sort(crossings);
        auto next = crossings.begin();
        int winding = 0;
        for (int i = 0; i < window.width() * kSamples; ++i) {
            const double x = window.x0 * kFixedOne + (i + 0.5) * kStep;
            for (; next != crossings.end() && next->first < x; ++next) winding += next->second;
            if (winding != 0) out[static_cast<std::size_t>(i / kSamples)] += 1.0 / (kSamples * kSamples);
        }
    }
    return out;
}

// The share of 8 × 8 samples of a pixel that lie in one of the discs along the way of a stroke.
double sampled_discs(const Stroke& s, int x, int y) {
    constexpr int kSamples = 8;
    const std::size_t n = s.vertices.size();
    const auto is_in = [&](double px, double py) {
        for (std::size_t i = 0; i + (s.closed ? 0 : 1) < n; ++i) {
            const StrokeVertex &a = s.vertices[i], &b = s.vertices[(i + 1) % n];
            const double dx = b.x - a.x, dy = b.y - a.y, length = std::hypot(dx, dy);
            const double slope = std::clamp((b.width - a.width) / 2 / length, -0.99, 0.99);
            const double off = std::fabs((px - a.x) * dy - (py - a.y) * dx) / length;
            const double foot =
                ((px - a.x) * dx + (py - a.y) * dy) / length + off * slope / std::sqrt(1 - slope * slope);
            const double along = std::clamp(foot, 0.0, length), t = along / length;
            if (std::hypot(a.x + t * dx - px, a.y + t * dy - py) <= a.width / 2 + slope * along) return true;
        }
        return false;
    };
    int covered = 0;
    for (int j = 0; j < kSamples; ++j)
        for (int i = 0; i < kSamples; ++i)
            if (is_in(x + (i + 0.5) / kSamples, y + (j + 0.5) / kSamples)) ++covered;
    return covered / double(kSamples * kSamples);
}

float greatest_difference(const Image& a, const Image& b, int dx = 0, int dy = 0) {
    float most = 0;
    for (int y = a.window.y0; y < a.window.y1; ++y)
        for (int x = a.window.x0; x < a.window.x1; ++x)
            most = std::max(most, std::fabs(a.at("A", x, y) - b.at("A", x + dx, y + dy)));
    return most;
}

Stroke ring(double x, double y, double radius, double width) {
    Places places;
    for (int i = 0; i < 40; ++i)
        places.emplace_back(x + radius * std::cos(i * 0.05 * M_PI), y + radius * std::sin(i * 0.05 * M_PI));
    return stroke(places, width, StrokeKind::kOutline, true);
}

TEST(DrawStrokes, CoversWhatALineCovers) {
    const Image image = draw_strokes("draw", {}, strokes_in({0, 0, 8, 4}, {stroke({{2, 2}, {6, 2}}, 1)}));
    EXPECT_EQ(image.window, (Rect{0, 0, 8, 4}));
    EXPECT_EQ(image.at("A", 4, 0), 0);
    EXPECT_EQ(image.at("A", 4, 1), 0.5F);
    EXPECT_EQ(image.at("A", 4, 2), 0.5F);
    EXPECT_NEAR(image.at("A", 6, 2), M_PI / 16, 0.01) << "a quarter of a round end";
    EXPECT_EQ(image.at("A", 7, 2), 0);
}

TEST(DrawStrokes, IsWithinAStepOfEightBitsOfItsOutlineSampled) {
    for (const unsigned seed : {3U, 5U, 8U, 11U}) {
        const Strokes strokes = random_strokes(seed, kFrame);
        for (const Stroke& s : strokes.strokes) {
            Stroke opaque = s;
            for (StrokeVertex& v : opaque.vertices) v.opacity = 1;
            const Image image = draw_strokes("draw", {}, strokes_in(kFrame, {opaque}));
            const std::vector<Loop> loops = outline_of(s);
            for (int y = kFrame.y0; y < kFrame.y1; ++y) {
                const std::vector<double> row = sampled_row(loops, kFrame, y);
                for (int x = kFrame.x0; x < kFrame.x1; ++x)
                    ASSERT_NEAR(image.at("A", x, y), row[static_cast<std::size_t>(x - kFrame.x0)], 1.0 / 255)
                        << x << ' ' << y;
            }
        }
    }
}

TEST(DrawStrokes, CoversTheDiscsAlongTheWay) {
    const std::vector<Stroke> strokes{stroke({{5, 8}, {20, 8.5}, {20, 20}}, 3), ring(15, 18, 8, 2),
                                      ring(15, 18, 2, 6), ring(15, 18, 0.5, 4)};
    for (const Stroke& s : strokes) {
        const Image image = draw_strokes("draw", {}, strokes_in(kFrame, {s}));
        for (int y = kFrame.y0; y < kFrame.y1; ++y)
            for (int x = kFrame.x0; x < kFrame.x1; ++x)
                ASSERT_NEAR(image.at("A", x, y), sampled_discs(s, x, y), 0.08) << x << ' ' << y;
    }
}

TEST(DrawStrokes, CoversTheDiscsOfShortPiecesThatSwellAndTurn) {
    for (unsigned seed = 1; seed <= 40; ++seed) {
        std::mt19937 random(seed);
        const auto any = [&](double from, double to) {
            return from + (to - from) * static_cast<double>(random() % 1000) / 1000;
        };
        Stroke s = stroke({{12.3, 18.6}}, 0.4);
        double way = any(0, 6);
        for (int i = 0; i < 14; ++i, way += any(-1, 1)) {
            StrokeVertex v = s.vertices.back();
            const double length = any(0.6, 1.4);
            v.x += length * std::cos(way);
            v.y += length * std::sin(way);
            v.width = std::max(0.3, v.width + length * any(-1.4, 1.6));
            s.vertices.push_back(v);
        }
        const Image image = draw_strokes("draw", {}, strokes_in(kFrame, {s}));
        for (int y = kFrame.y0; y < kFrame.y1; ++y)
            for (int x = kFrame.x0; x < kFrame.x1; ++x)
                ASSERT_NEAR(image.at("A", x, y), sampled_discs(s, x, y), 0.1) << seed << ' ' << x << ' ' << y;
    }
}

TEST(DrawStrokes, TapersBetweenWidths) {
    Stroke s = stroke({{4, 10}, {24, 10}});
    s.vertices[0].width = 8;
    s.vertices[1].width = 0;
    const Image image = draw_strokes("draw", {}, strokes_in(kFrame, {s}));
    double across = 0;
    for (int y = kFrame.y0; y < kFrame.y1; ++y) across += image.at("A", 13, y);
    EXPECT_NEAR(across, 4.2 / std::sqrt(1 - 0.04), 0.01) << "between its tangents, at 13.5";
}

TEST(DrawStrokes, MovedByWholePixelsIsTheSamePictureMoved) {
    const Strokes strokes = random_strokes(7, {0, 0, 30, 30});
    Strokes other = strokes;
    for (Stroke& s : other.strokes) s = moved(s, 3, -5);
    other.display = other.window = translate(strokes.window, 3, -5);
    EXPECT_EQ(greatest_difference(draw_strokes("draw", {}, strokes), draw_strokes("draw", {}, other), 3, -5),
              0);
}

TEST(DrawStrokes, MirroredIsTheSamePictureMirrored) {
    Strokes strokes = strokes_in({0, 0, 30, 30}, {ring(14, 14, 9.3, 2.2), stroke({{3, 4}, {20, 9.5}}, 1.7)});
    const Image image = draw_strokes("draw", {}, strokes);
    for (Stroke& s : strokes.strokes)
        for (StrokeVertex& v : s.vertices) v.x = 30 - v.x;
    const Image mirrored = draw_strokes("draw", {}, strokes);
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 30; ++x) ASSERT_NEAR(image.at("A", x, y), mirrored.at("A", 29 - x, y), 0.01);
}

TEST(DrawStrokes, DrawnFourTimesAsLargeAndBoxedDownIsTheSamePicture) {
    Strokes strokes = strokes_in({0, 0, 30, 30}, {ring(14, 14, 9.3, 2.2), stroke({{3, 4}, {20, 9.5}}, 1.7)});
    const Image image = draw_strokes("draw", {}, strokes);
    strokes.display = strokes.window = {0, 0, 120, 120};
    for (Stroke& s : strokes.strokes)
        for (StrokeVertex& v : s.vertices) {
            v.x *= 4;
            v.y *= 4;
            v.width *= 4;
        }
    const Image large = draw_strokes("draw", {}, strokes);
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 30; ++x) {
            double sum = 0;
            for (int j = 0; j < 4; ++j)
                for (int i = 0; i < 4; ++i) sum += large.at("A", 4 * x + i, 4 * y + j);
            // Crossings are united within each small pixel, so that seams are a little lighter.
            ASSERT_NEAR(image.at("A", x, y), sum / 16, 0.12) << x << ' ' << y;
        }
}

TEST(DrawStrokes, HasTheOpacityOfTheNearestPlace) {
    Stroke s = stroke({{2, 5}, {12, 5}, {22, 5}}, 4);
    s.vertices[1].opacity = 0.5;
    s.vertices[2].opacity = 0;
    const Image image = draw_strokes("draw", {}, strokes_in(kFrame, {s}));
    EXPECT_NEAR(image.at("A", 6, 4), 0.775, 1e-6);
    EXPECT_NEAR(image.at("A", 11, 5), 0.525, 1e-6);
    EXPECT_NEAR(image.at("A", 16, 5), 0.275, 1e-6);
    EXPECT_EQ(image.at("A", 23, 5), 0);
}

TEST(DrawStrokes, TakesTheStrokesOwnColour) {
    std::vector<Stroke> strokes{stroke({{2, 5}, {12, 5}}, 2), stroke({{2, 15}, {12, 15}}, 2)};
    strokes[1].color = Color{0.25, 0.5, 0};
    const Image image = draw_strokes("draw", {{"color", Json{1, 0, 0}}}, strokes_in(kFrame, strokes));
    EXPECT_EQ(image.at("R", 6, 5), 1);
    EXPECT_EQ(image.at("R", 6, 15), 0.25F);
    EXPECT_EQ(image.at("G", 6, 15), 0.5F);
}

TEST(DrawStrokes, DontDarkenWhereTheyCrossUnlessAsked) {
    std::vector<Stroke> strokes{stroke({{2, 10}, {20, 10}}, 2), stroke({{10, 5}, {10, 20}}, 2)};
    for (Stroke& s : strokes)
        for (StrokeVertex& v : s.vertices) v.opacity = 0.5;
    strokes[0].color = Color{1, 0, 0};
    strokes[1].color = Color{0, 1, 0};
    const Strokes all = strokes_in(kFrame, strokes);
    const Image united = draw_strokes("draw", {}, all),
                over = draw_strokes("draw", {{"overlap", "over"}}, all);
    EXPECT_EQ(united.at("A", 10, 10), 0.5F);
    EXPECT_EQ(over.at("A", 10, 10), 0.75F);
    EXPECT_EQ(over.at("G", 10, 10), 0.5F) << "the first in order lies on top: it begins higher";
    EXPECT_EQ(over.at("R", 10, 10), 0.25F);
    EXPECT_NEAR(united.at("G", 10, 10), 1.0 / 3, 1e-6);
}

TEST(DrawStrokes, TakesTheWindowsOfAnImage) {
    const Strokes strokes = strokes_in({0, 0, 8, 8}, {stroke({{-2, 5}, {12, 5}}, 2)});
    Image like({-3, 2, 20, 9}, {"Y"});
    like.display = {0, 0, 10, 10};
    const Image image = draw_strokes("draw", {}, strokes, {}, {{"like", like}});
    EXPECT_EQ(image.display, like.display);
    EXPECT_EQ(image.window, (Rect{-3, 0, 20, 10}));
    EXPECT_EQ(image.at("A", -2, 4), 1);
    EXPECT_EQ(image.at("A", 11, 4), 1);
}

TEST(DrawStrokes, TellsWhereAlongItsLineAPixelIs) {
    Stroke s = stroke({{4, 10}, {24, 10}}, 4);
    s.vertices[1].width = 2;
    s.vertices[0].depth = 6;
    s.vertices[1].depth = 8;
    measure(s);
    Stroke unknown = stroke({{10, 20}, {20, 20}}, 2);
    unknown.vertices[0].depth = 5;
    measure(unknown);
    const Json params{{"channels", {"id", "u", "v", "width", "Z"}}};
    const Image image = draw_strokes("draw", params, strokes_in(kFrame, {s, unknown}));
    const auto id_at = [&](int x, int y) { return std::bit_cast<uint32_t>(image.at("line.id", x, y)); };
    EXPECT_EQ(id_at(13, 9), 1U);
    EXPECT_NEAR(image.at("line.u", 13, 9), 0.475, 1e-6);
    EXPECT_NEAR(image.at("line.width", 13, 9), 3.05, 1e-6);
    EXPECT_NEAR(image.at("line.Z", 13, 9), 6.95, 1e-6);
    EXPECT_NEAR(image.at("line.v", 13, 9), -0.5 / 1.525, 1e-6) << "on its left, as it runs to the right";
    EXPECT_NEAR(image.at("line.v", 13, 10), 0.5 / 1.525, 1e-6) << "and its owner is below";
    EXPECT_EQ(id_at(15, 19), 2U);
    EXPECT_EQ(image.at("line.Z", 15, 19), 5) << "known at one end only";
    for (const char* channel : {"line.u", "line.v", "line.width", "line.Z"})
        EXPECT_EQ(image.at(channel, 15, 15), 0) << channel;
    EXPECT_EQ(id_at(15, 15), 0U) << "between both";
    EXPECT_FALSE(draw_strokes("draw", {}, strokes_in(kFrame, {s})).has("line.u")) << "unless asked for";
}

TEST(DrawStrokes, TellsTheSameForAllTilesAndThreads) {
    const Json params{{"channels", {"id", "u", "v", "width", "Z"}}};
    for (unsigned seed = 1; seed < 5; ++seed) {
        const Strokes strokes = random_strokes(seed, kFrame);
        const Image whole = draw_strokes("draw", params, strokes, {1, 0});
        EXPECT_IMAGE(draw_strokes("draw", params, strokes, {2, 7}), whole);
        for (int y = kFrame.y0; y < kFrame.y1; ++y)
            for (int x = kFrame.x0; x < kFrame.x1; ++x) {
                const float u = whole.at("line.u", x, y), v = whole.at("line.v", x, y);
                ASSERT_TRUE(u >= 0 && u <= 1 && v >= -1 && v <= 1) << u << ' ' << v;
                const bool line = std::bit_cast<uint32_t>(whole.at("line.id", x, y)) > 0;
                ASSERT_EQ(line, whole.at("A", x, y) > 0) << x << ' ' << y;
            }
    }
}

// As of idedge: by name they come apart again, and together they are all there is.
TEST(DrawStrokes, ArePickedByTheNameOfTheirOwner) {
    const auto of = [](const char* objects) {
        return Json{{"type", "cryptomatte"}, {"in", "lines"}, {"objects", {objects}}};
    };
    const Json nodes{
        {"r", {{"type", "read"}, {"file", KEYLINE_PLATE}}},
        {"strokes", {{"type", "contours"}, {"in", "r"}, {"layer", "CryptoObject"}, {"depth", "r:Depth"}}},
        {"lines", {{"type", "draw"}, {"in", "strokes"}, {"owner", "r"}, {"layer", "CryptoObject"}}},
        {"monkey", of("suzanne")},
        {"all", of("*")}};
    const std::map<std::string, Image> none;
    const Image lines = run_graph(nodes, "lines", none), monkey = run_graph(nodes, "monkey", none),
                all = run_graph(nodes, "all", none);
    double hers = 0, of_all = 0;
    for (int y = 0; y < 270; ++y)
        for (int x = 0; x < 480; ++x) {
            const float matte = monkey.at("matte", x, y);
            ASSERT_TRUE(matte == 0 || matte == lines.at("edge", x, y)) << x << ' ' << y;
            ASSERT_EQ(all.at("matte", x, y), lines.at("edge", x, y));
            ASSERT_EQ(lines.at("edge", x, y), lines.at("A", x, y)) << "as lines of one opacity unite";
            hers += double{matte};
            of_all += double{all.at("matte", x, y)};
        }
    EXPECT_GT(hers, 150);
    EXPECT_LT(hers, of_all / 4);
}

// Red above 20, blue below; each line is as what it belongs to, on its right, along its whole way.
TEST(DrawStrokes, IsTintedByWhatAStrokeBelongsTo) {
    const Image tint = Image(kFrame, {"R", "G", "B"})
                           .fill("R", [](int, int y) { return y < 20 ? 0.8 : 0; })
                           .fill("B", [](int, int y) { return y < 20 ? 0 : 0.4; });
    const Strokes strokes =
        strokes_in(kFrame, {stroke({{5, 20}, {25, 20}}, 2), stroke({{25, 10}, {5, 10}}, 2)});
    const Image image =
        draw_strokes("draw", {{"color", {0.5, 0.5, 0.5}}, {"tint", "tint"}}, strokes, {}, {{"tint", tint}});
    for (const int y : {19, 20}) {
        EXPECT_EQ(image.at("R", 15, y), 0);
        EXPECT_FLOAT_EQ(image.at("B", 15, y), 0.2F);
    }
    EXPECT_FLOAT_EQ(image.at("R", 15, 10), 0.4F);
    EXPECT_EQ(image.at("B", 15, 10), 0);
}

TEST(DrawStrokes, BearsStrokesOfAnySize) {
    constexpr double kFar = 1e300;
    const std::vector<Stroke> strokes{
        stroke({{-kFar, 10}, {kFar, 10}}, 2), stroke({{1e6, -1e6}, {1e6, 1e6}}, 5),
        stroke({{15, 20}, {16, 20}}, 1e-9),   stroke({{-1e5, -1e5}, {1e5, -1e5}}, 1),
        stroke({{5, 25}, {5, 25}}, 4),        stroke({{5, 5}, {6, 5}, {5, 5}}, 0)};
    for (const Stroke& s : strokes) {
        const Image image = draw_strokes("draw", {}, strokes_in(kFrame, {s}));
        for (const float a : image.channel("A").samples) ASSERT_TRUE(a >= 0 && a <= 1);
    }
    EXPECT_EQ(draw_strokes("draw", {}, strokes_in(kFrame, {strokes[0]})).at("A", 3, 9), 1);
    EXPECT_EQ(draw_strokes("draw", {}, strokes_in(kFrame, {strokes[4]})).at("A", 5, 25), 1) << "a dot";
    const Image all = draw_strokes("draw", {}, strokes_in({0, 0, 9, 9}, {stroke({{4, 4}, {5, 5}}, 1e7)}));
    for (const float a : all.channel("A").samples) EXPECT_EQ(a, 1);
}

TEST(DrawStrokes, DrawsNothingOfNothing) {
    const Image image = draw_strokes("draw", {}, strokes_in(kFrame, {}));
    for (const float a : image.channel("A").samples) EXPECT_EQ(a, 0);
}

}  // namespace
}  // namespace keyline::testing
