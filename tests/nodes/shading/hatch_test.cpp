// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/nodes/plate.h"

#include <cmath>

namespace keyline::testing {
namespace {

using Images = std::map<std::string, Image>;

constexpr double kPi = 3.14159265358979323846;

Image tone(const Rect& window, double value) {
    return Image(window, {"Y"}).fill("Y", [&](int, int) { return value; });
}

double mean(const Image& image) {
    double sum = 0;
    for (const float s : image.channel("matte").samples) sum += double{s};
    return sum / static_cast<double>(image.channel("matte").samples.size());
}

// The share of `length` around `at` that lies within `width` / 2 of a multiple of `spacing`, counted.
double counted(double at, double length, double spacing, double width) {
    constexpr int kPoints = 20000;
    int inside = 0;
    for (int i = 0; i < kPoints; ++i) {
        const double p = at + length * ((i + 0.5) / kPoints - 0.5);
        if (std::abs(p - std::round(p / spacing) * spacing) <= width / 2) ++inside;
    }
    return double(inside) / kPoints;
}

TEST(Hatch, StrokesAreAntialiasedExactly) {
    const double angle = 30, spacing = 5.3, width = 2.2, dark = 0.6;
    const Rect window{-11, 7, 9, 12};
    const Image out =
        run("hatch", {{"angles", {angle}}, {"spacing", spacing}, {"width", width}}, tone(window, 1 - dark));
    const double s = std::sin(angle * kPi / 180), c = std::cos(angle * kPi / 180);
    for (int y = window.y0; y < window.y1; ++y)
        for (int x = window.x0; x < window.x1; ++x)
            ASSERT_NEAR(out.at("matte", x, y),
                        counted((x + 0.5) * s + (y + 0.5) * c, s + c, spacing, width * dark), 2e-4)
                << x << ',' << y;
}

TEST(Hatch, WidensAsTheToneDarkens) {
    const Rect window{0, 0, 200, 200};
    const auto ink = [&](double value) {
        return mean(run("hatch", {{"angles", {45}}, {"spacing", 10}, {"width", 5}}, tone(window, value)));
    };
    EXPECT_EQ(ink(1), 0);
    EXPECT_NEAR(ink(0.5), 0.25, 0.01);
    EXPECT_NEAR(ink(0), 0.5, 0.01);
    EXPECT_NEAR(ink(-3), 0.5, 0.01);
}

TEST(Hatch, ADarkerBandHasOneDirectionMore) {
    const Rect window{0, 0, 40, 40};
    const Json one{{"angles", {0}}, {"spacing", 8}, {"width", 4}};
    const Json two{{"angles", {0, 90}}, {"spacing", 8}, {"width", 4}};
    EXPECT_IMAGE(run("hatch", two, tone(window, 0.5)), run("hatch", one, tone(window, 0)));
    const Image crossed = run("hatch", two, tone(window, 0));
    EXPECT_EQ(crossed.at("matte", 8, 4), 1);
    EXPECT_EQ(crossed.at("matte", 4, 8), 1);
    EXPECT_EQ(crossed.at("matte", 4, 4), 0);
}

TEST(Hatch, HangsOnCoordinates) {
    const Rect window{0, 0, 60, 30};
    Image uv(window, {"U", "V"});
    uv.fill("U", [](int x, int) { return 0.37 + (x + 0.5) / 50; });
    uv.fill("V", [](int, int y) { return (y + 0.5) / 25; });
    const Image out = run("hatch", {{"angles", {90}}, {"spacing", 0.2}, {"width", 0.1}},
                          Images{{"in", tone(window, 0)}, {"coords", uv}});
    for (int x = 0; x < 60; ++x)
        ASSERT_NEAR(out.at("matte", x, 15), counted(0.37 + (x + 0.5) / 50, 0.02, 0.2, 0.1), 1e-3) << x;
}

TEST(Hatch, TakesCoordinatesByName) {
    const Image in = noise({0, 0, 20, 20}, {"Y"}, 1), uva = noise({0, 0, 20, 20}, {"A", "V", "U"}, 2, 0, 9);
    Image uv({0, 0, 20, 20}, {"U", "V"});
    for (const char* name : {"U", "V"}) uv.channel(name).samples = uva.channel(name).samples;
    EXPECT_IMAGE(run("hatch", {}, Images{{"in", in}, {"coords", uva}}),
                 run("hatch", {}, Images{{"in", in}, {"coords", uv}}));
    const Json nodes{{"n", {{"type", "hatch"}, {"in", "in"}, {"coords", "colour"}}}};
    try {
        run_graph(nodes, "n", Images{{"in", in}, {"colour", noise({0, 0, 20, 20}, {"R", "G", "B"}, 3)}});
        FAIL() << "accepted";
    } catch (const Failure& f) {
        EXPECT_NE(std::string(f.what()).find("'coords' needs channels U and V"), std::string::npos)
            << f.what();
    }
}

TEST(Hatch, NanHasNoStrokes) {
    EXPECT_EQ(run("hatch", {{"spacing", 2}, {"width", 2}}, ascii({"x"})).at("matte", 0, 0), 0);
    Image uv({0, 0, 1, 1}, {"U", "V"});
    uv.at("U", 0, 0) = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(run("hatch", {}, Images{{"in", ascii({"."})}, {"coords", uv}}).at("matte", 0, 0), 0);
}

TEST(Hatch, DoesNotDependOnTheTile) {
    const Image in = plate("ViewLayer.DiffCol", {"R"}), uv = plate("ViewLayer.UV", {"U", "V"});
    const Json params{{"spacing", 0.05}, {"width", 0.03}};
    EXPECT_IMAGE(run("hatch", params, Images{{"in", in}, {"coords", uv}}, {2, 37}),
                 run("hatch", params, Images{{"in", in}, {"coords", uv}}, {1, 1000}));
}

TEST(Hatch, StrokesAsWideAsTheirSpacingOrWiderCoverEverything) {
    const Json wide{{"spacing", 2}, {"width", 3}}, just{{"spacing", 2}, {"width", 2}};
    const Image in = ascii({"......", "......"});
    EXPECT_IMAGE(run("hatch", wide, in), run("hatch", just, in));
}

}  // namespace
}  // namespace keyline::testing
