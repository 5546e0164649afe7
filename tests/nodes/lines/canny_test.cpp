// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/run.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <gmock/gmock.h>
#include <set>

// What the chain gaussian, gradient, nms, hysteresis promises of pictures whose lines are known: rounding
// draws none, and moves none.

namespace keyline::testing {
namespace {

const std::vector<const char*> kOperators{"central", "sobel", "prewitt", "scharr"};

struct Canny {
    double sigma = 1.4;
    const char* gradient = "central";
    Json thresholds = {{"low", 0}, {"high", 0}};

    Json nodes() const {
        Json lines = thresholds;
        lines.set("type", "hysteresis").set("in", "thin");
        return {{"smooth", {{"type", "gaussian"}, {"in", "picture"}, {"sigma", sigma}}},
                {"slope", {{"type", "gradient"}, {"in", "smooth"}, {"operator", gradient}}},
                {"thin", {{"type", "nms"}, {"in", "slope"}}},
                {"lines", lines}};
    }
    Image lines(const Image& picture, const char* node = "lines") const {
        return run_graph(nodes(), node, std::map<std::string, Image>{{"picture", picture}});
    }
    friend void PrintTo(const Canny& c, std::ostream* out) {
        *out << "sigma " << c.sigma << ", " << c.gradient << ", " << c.thresholds.text();
    }
};

// Half, as renderers write it.
Image picture(const Rect& window, const std::function<double(int, int)>& f) {
    Image image(window, {"Y"});
    image.channels[0].type = SampleType::kHalf;
    return image.fill("Y", f);
}

int count(const Image& lines) {
    const std::vector<float>& samples = lines.channels[0].samples;
    return static_cast<int>(std::ranges::count_if(samples, [](float v) { return v > 0; }));
}

Image fading_wall(double light) {
    return picture({0, 0, 48, 32}, [light](int x, int) { return x < 24 ? 0.1 : light; });
}

void expect_still(const Canny& canny, int frames) {
    SCOPED_TRACE(::testing::PrintToString(canny));
    const Image first = canny.lines(fading_wall(0.3));
    ASSERT_EQ(count(first), 30);
    for (int k = 1; k < frames; ++k)
        ASSERT_TRUE(same(canny.lines(fading_wall(0.3 + 0.6 * k / (frames - 1))), first)) << "frame " << k;
}

TEST(Canny, AStillEdgeStaysWhereItIsWhileItsLightFades) {
    for (const double sigma : {0.0, 0.5, 1.0, 1.4, 2.0})
        for (const char* gradient : kOperators) {
            const bool usual = std::string_view(gradient) == "central";
            expect_still({sigma, gradient, {{"low", 0.01}, {"high", 0.02}}}, usual ? 48 : 12);
        }
}

TEST(Canny, AWallInFlatBandsHasItsEdgeInOneColumn) {
    const Image wall = picture({0, 0, 48, 160}, [](int x, int y) {
        const int band = y / 16;
        return x < 24 ? 0.1 : 0.3 + 0.06 * band;
    });
    for (const double sigma : {0.0, 0.5, 1.0, 1.4, 2.0}) {
        const Image thin = Canny{sigma}.lines(wall, "thin");
        std::set<int> columns;
        for (int band = 0; band < 10; ++band)
            for (int x = 20; x < 28; ++x)
                if (thin.at("magnitude", x, band * 16 + 8) > 0) columns.insert(x);
        EXPECT_EQ(columns.size(), 1U) << sigma;
    }
}

TEST(Canny, AFlatFrameHasNoLines) {
    const std::vector<Json> units{{{"low", 0}, {"high", 0}},
                                  {{"low", 0.1}, {"high", 0.3}, {"units", "max"}},
                                  {{"low", 80}, {"high", 96}, {"units", "percentile"}},
                                  {{"low", 0}, {"high", 0}, {"units", "percentile"}}};
    std::size_t n = 0;  // the units take turns
    for (const Rect& window : {Rect{0, 0, 1, 1}, Rect{0, 0, 3, 2}, Rect{-5, 7, 12, 16}, Rect{0, 0, 90, 64}})
        for (const double sigma : {0.3, 0.5, 0.7, 1.0, 1.4, 2.0, 3.3, 5.0, 20.0})
            for (const double grey : {0.3, 0.05, 0.5, 0.7, 1.0, 37.3}) {
                const Canny canny{sigma, kOperators[n % 4U], units[n / 4 % 4U]};
                ++n;
                const Image flat = picture(window, [grey](int, int) { return grey; });
                ASSERT_EQ(count(canny.lines(flat)), 0) << ::testing::PrintToString(canny) << grey << window;
            }
}

// Shapes in flat tones on nothing, off every middle.
Image shapes(int x0, int y0) {
    return picture({x0, y0, x0 + 31, y0 + 23}, [=](int px, int py) {
        const int x = px - x0, y = py - y0;
        if (x > 3 && x < 14 && y > 2 && y < 9) return 0.4;
        if ((x - 20) * (x - 20) + (y - 13) * (y - 13) < 50) return 0.7;
        return x > 6 && x + y > 16 && x + y < 27 ? 0.2 : 0.0;
    });
}

const std::vector<Canny>& some_cannies() {
    static const std::vector<Canny> cannies{
        {0, "central"},
        {0.5, "sobel"},
        {1, "scharr"},
        {1.4, "central", {{"low", 0.05}, {"high", 0.2}}},
        {1.4, "prewitt", {{"low", 0.1}, {"high", 0.4}, {"units", "max"}}},
        {2, "sobel", {{"low", 30}, {"high", 80}, {"units", "percentile"}}}};
    return cannies;
}

TEST(Canny, LinesMoveWithThePicture) {
    const Rect display{0, 0, 70, 60};
    for (const Canny& canny : some_cannies()) {
        Image here = shapes(15, 14);
        here.display = display;
        const Image lines = canny.lines(here);
        EXPECT_GT(count(lines), 40);
        for (const auto& [dx, dy] : {std::pair{1, 0}, std::pair{0, 1}, std::pair{7, 9}, std::pair{-3, 5}}) {
            Image there = shapes(15 + dx, 14 + dy);
            there.display = display;
            const Image moved_lines = canny.lines(there);
            for (int y = 0; y < 60; ++y)
                for (int x = 0; x < 70; ++x)
                    ASSERT_EQ(moved_lines.at("edge", x + dx, y + dy), lines.at("edge", x, y))
                        << ::testing::PrintToString(canny) << x << ',' << y;
        }
    }
}

Image mirrored(const Image& in, bool across, bool down) {
    Image out = in;
    const Rect& w = in.window;
    return out.fill(in.channels[0].name, [&](int x, int y) {
        return in.at(in.channels[0].name, across ? w.x0 + w.x1 - 1 - x : x, down ? w.y0 + w.y1 - 1 - y : y);
    });
}

// A plateau keeps its last pixel along the gradient, which a mirror turns round with it.  (The gradient of
// several channels has no such direction, and then a plateau's line may be on its other side.)
TEST(Canny, AMirroredPictureHasMirroredLines) {
    const Image tones = picture({2, 3, 63, 50}, [](int x, int y) {
        return static_cast<double>((x / 7 * 5 + y / 6 * 3 + (x * y) / 90) % 6) / 5;
    });
    for (const Image& in : {shapes(4, 5), tones})
        for (const Canny& canny : some_cannies()) {
            const Image lines = canny.lines(in);
            for (const auto& [across, down] : {std::pair{true, false}, std::pair{false, true}})
                ASSERT_TRUE(same(canny.lines(mirrored(in, across, down)), mirrored(lines, across, down)))
                    << ::testing::PrintToString(canny);
        }
}

// Whether one can walk from a pixel to the frame's rim without crossing a line.
bool is_open(const Image& lines, int x0, int y0) {
    Image seen = lines;
    std::vector<std::pair<int, int>> open{{x0, y0}};
    while (!open.empty()) {
        const auto [x, y] = open.back();
        open.pop_back();
        if (!lines.window.contains(x, y)) return true;
        if (seen.at("edge", x, y) > 0) continue;
        seen.at("edge", x, y) = 1;
        for (const auto& [dx, dy] : {std::pair{1, 0}, std::pair{-1, 0}, std::pair{0, 1}, std::pair{0, -1}})
            open.emplace_back(x + dx, y + dy);
    }
    return false;
}

TEST(Canny, TheContourOfASquareIsClosed) {
    const std::vector<Json> units{{{"low", 0}, {"high", 0}},
                                  {{"low", 0}, {"high", 50}, {"units", "percentile"}},
                                  {{"low", 0}, {"high", 100}, {"units", "percentile"}}};
    for (const auto& [dark, light] : {std::pair{0.0, 1.0}, std::pair{0.18, 0.7}})
        for (const double sigma : {0.0, 0.7, 1.0, 1.4, 2.0}) {
            const Image square = picture({0, 0, 64, 64}, [dark = dark, light = light](int x, int y) {
                return x >= 20 && x < 44 && y >= 20 && y < 44 ? light : dark;
            });
            for (const Json& thresholds : units) {
                const Canny canny{sigma, "central", thresholds};
                const Image lines = canny.lines(square);
                EXPECT_FALSE(is_open(lines, 32, 32)) << ::testing::PrintToString(canny);
                EXPECT_EQ(count(lines), count(only(canny.lines(square, "thin"), {"magnitude"})))
                    << ::testing::PrintToString(canny);
            }
            // Of the samples a rank is taken of, all that are equal to it are kept.
            const Image thin = only(Canny{sigma}.lines(square, "thin"), {"magnitude"});
            std::vector<float> ridge;
            for (const float v : thin.channels[0].samples)
                if (v > 0) ridge.push_back(v);
            std::ranges::sort(ridge);
            const auto rank = static_cast<std::size_t>(std::ceil(0.8 * static_cast<double>(ridge.size())));
            const float least = ridge[rank - 1] * (1 - 0x1p-18F);
            const Canny usual{sigma, "central", {{"low", 80}, {"high", 96}, {"units", "percentile"}}};
            EXPECT_EQ(count(usual.lines(square)),
                      std::ranges::count_if(ridge, [&](float v) { return v >= least; }))
                << sigma;
        }
}

// The data window of renderers ends at the object.
TEST(Canny, ADataWindowCutToTheObjectChangesNoLine) {
    for (const Canny& canny : some_cannies()) {
        Image cut = picture({20, 14, 40, 30}, [](int, int) { return 0.5; });
        cut.display = {0, 0, 64, 48};
        const Image whole =
            picture(cut.display, [&](int x, int y) { return std::as_const(cut).at("Y", x, y); });
        const Image lines = canny.lines(whole), of_cut = canny.lines(cut);
        EXPECT_GT(count(lines), 30);
        for (int y = 0; y < 48; ++y)
            for (int x = 0; x < 64; ++x)
                ASSERT_EQ(of_cut.at("edge", x, y), lines.at("edge", x, y)) << x << ',' << y;
    }
}

TEST(Canny, ASharpLineTwoPixelsWideHasTwoSides) {
    for (const char* gradient : kOperators)
        for (const int width : {1, 2, 3, 4, 5}) {
            const auto line = [width](int at) { return at >= 15 && at < 15 + width ? 0.8 : 0.2; };
            const Image upright = picture({0, 0, 36, 24}, [&](int x, int) { return line(x); });
            const Image level = picture({0, 0, 24, 36}, [&](int, int y) { return line(y); });
            EXPECT_EQ(count(Canny{0, gradient}.lines(upright)), 2 * 22) << gradient << width;
            EXPECT_EQ(count(Canny{0, gradient}.lines(level)), 2 * 22) << gradient << width;
        }
}

}  // namespace
}  // namespace keyline::testing
