// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/nodes/pattern_reference.h"

#include <gmock/gmock.h>

namespace keyline::testing {
namespace {

double smoothstep(double low, double high, double x) {
    const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

struct WoodFormula {
    double plankwidth = 0.2, spacewidth = 0.02, texturescale = 8, ringfactor = 25, wavefactor = 0.8,
           colorvariation = 0.5;
    Rgb woodcolor{0.57, 0.292, 0.125}, ringcolor{0.275, 0.15, 0.06}, spacecolor{};

    Json json() const {
        return {{"plankwidth", plankwidth},
                {"spacewidth", spacewidth},
                {"texturescale", texturescale},
                {"ringfactor", ringfactor},
                {"wavefactor", wavefactor},
                {"colorvariation", colorvariation},
                {"spacecolor", {spacecolor[0], spacecolor[1], spacecolor[2]}}};
    }

    Rgb operator()(double u, double v) const {
        double s = u * texturescale, t = v * texturescale;
        if (modulo(std::floor(s) + std::floor(t), 2) == 1) std::swap(s, t);
        const double row = std::floor(t), plank = std::floor(fract(s) / plankwidth);
        const double column = std::floor(s) * std::ceil(1 / plankwidth) + plank;
        if (fract(s) - plank * plankwidth < spacewidth || fract(t) < spacewidth) return spacecolor;
        const double wave = wavefactor * noise::value(8 * s, t / 4);
        double r = fract(ringfactor * noise::value(s - column, t / 4 + column + wave));
        r = 0.5 + 0.5 * smoothstep(0.2, 0.55, r) * (1 - smoothstep(0.75, 0.8, r));
        const double snoise = 2 * noise::value(row * column + 0.7) - 1;
        Rgb out;
        for (std::size_t c = 0; c < 3; ++c)
            out[c] = (ringcolor[c] * (1 - r) + woodcolor[c] * r) *
                     (1 - colorvariation / 2 + colorvariation * snoise);
        return out;
    }
};

const WoodFormula kOther{
    0.3, 0.05, 3, 10, 2, 0.2, {0.57, 0.292, 0.125}, {0.275, 0.15, 0.06}, {0.9, 0.1, 0.2}};

TEST(Wood, IsTheFormulaWhereAPixelHasNoExtent) {
    for (const WoodFormula& formula : {WoodFormula{}, kOther})
        EXPECT_IMAGE_NEAR(paint("wood", formula.json(), lonely_points(1)), drawn(lonely_points(1), formula),
                          1e-5);
}

TEST(Wood, IsTheFormulaWhereAPixelIsTiny) {
    const double step = 1.0 / (1 << 22);  // exact in float
    for (const auto& [u, v] : {std::pair{0.0625 + 0.01, 0.0313}, std::pair{0.76, 0.8}}) {
        const Image uv = plane(u, v, step, step, 10);
        EXPECT_IMAGE_NEAR(paint("wood", {}, uv), drawn(uv, WoodFormula{}), 1e-5);
    }
}

TEST(Wood, IsTheMeanOverAPixel) {
    for (const double size : {0.01, 0.05, 0.3, 1.0, 2.0}) {
        const double step = size / 8;
        const Image uv = plane(-0.4, 0.3, step, step, 30);
        const Differences d = differences(paint("wood", {}, uv), drawn_finely(uv, step, step, WoodFormula{}));
        EXPECT_LT(d.mean, 0.012) << size;
        EXPECT_LT(d.largest, 0.12) << size;
    }
}

TEST(Wood, DoesNotSparkleFarAway) {
    EXPECT_GT(deviation(paint("wood", {}, plane(0.1, 0.2, 0.002, 0.003))), 0.05);
    EXPECT_LT(deviation(paint("wood", {}, plane(0.1, 0.2, 0.27, 0.23))), 0.02);
    EXPECT_LT(deviation(paint("wood", {}, plane(0.1, 0.2, 7.7, 5.3))), 0.001);
}

TEST(Wood, FarAwayItHasItsMeanColour) {
    const Image far = paint("wood", kOther.json(), plane(0.1, 0.2, 7.7, 5.3, 4));
    const Image near = drawn_finely(plane(0.1, 0.2, 41.37, 39.1, 4), 41.37, 39.1, kOther, 200, 200);
    EXPECT_LT(differences(far, near).largest, 0.02);
}

TEST(Wood, IsAsTransparentAsItsCoordinates) {
    Image uv({0, 0, 3, 1}, {"A", "U", "V"});
    for (int x = 0; x < 3; ++x) {
        uv.at("A", x, 0) = 0.5F * static_cast<float>(x);
        uv.at("U", x, 0) = 0.0625F * uv.at("A", x, 0);
        uv.at("V", x, 0) = 0.03125F * uv.at("A", x, 0);
    }
    EXPECT_IMAGE_NEAR(paint("wood", {}, uv), drawn(uv, WoodFormula{}), 1e-6);
}

TEST(Wood, NanIsNan) {
    Image uv({0, 0, 1, 1}, {"U", "V"});
    uv.at("V", 0, 0) = std::numeric_limits<float>::quiet_NaN();
    EXPECT_TRUE(std::isnan(paint("wood", {}, uv).at("R", 0, 0)));
}

TEST(Wood, DoesNotDependOnTheTile) {
    const Image uv = plate("ViewLayer.UV", {"U", "V", "A"});
    EXPECT_IMAGE(paint("wood", {}, uv, {2, 37}), paint("wood", {}, uv, {1, 1000}));
}

TEST(Wood, AnEmptyWindowStaysEmpty) {
    EXPECT_TRUE(paint("wood", {}, Image({4, 4, 4, 9}, {"U", "V"})).window.empty());
}

}  // namespace
}  // namespace keyline::testing
