// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/nodes/pattern_reference.h"

#include <gmock/gmock.h>

namespace keyline::testing {
namespace {

struct BrickFormula {
    double brickwidth = 0.25, brickheight = 0.12, mortarwidth = 0.05, irregularity = 0.06, texturescale = 2,
           colorvariation = 0.5;
    Rgb brickcolor{0.83, 0.01, 0.12}, mortarcolor{0.5, 0.5, 0.5};

    Json json() const {
        return {{"brickwidth", brickwidth},     {"brickheight", brickheight},
                {"mortarwidth", mortarwidth},   {"irregularity", irregularity},
                {"texturescale", texturescale}, {"colorvariation", colorvariation}};
    }

    Rgb operator()(double u, double v) const {
        const double x = u / brickwidth, y = v / brickheight;
        double s = (u + irregularity * noise::value(x, y)) * texturescale / brickwidth;
        const double t = (v + irregularity * noise::value(x + 71.37, y + 43.61)) * texturescale / brickheight;
        if (modulo(t, 2) > 1) s += 0.5;
        if (fract(s) < mortarwidth || fract(t) < mortarwidth) return mortarcolor;
        return times(brickcolor,
                     1 + colorvariation * noise::value(std::floor(s) * std::floor(t) / 2.3 + 3.7));
    }
};

const BrickFormula kOther{0.4, 0.3, 0.2, 0.15, 5, 1.5};

TEST(Brick, IsTheFormulaWhereAPixelHasNoExtent) {
    for (const BrickFormula& formula : {BrickFormula{}, kOther})
        EXPECT_IMAGE_NEAR(paint("brick", formula.json(), lonely_points(1)), drawn(lonely_points(1), formula),
                          1e-5);
}

TEST(Brick, IsTheFormulaWhereAPixelIsTiny) {
    const double step = 1.0 / (1 << 20);  // exact in float
    for (const auto& [u, v] : {std::pair{0.0625, 0.0313}, std::pair{0.75, 0.8125}}) {
        const Image uv = plane(u, v, step, step);
        EXPECT_IMAGE_NEAR(paint("brick", {}, uv), drawn(uv, BrickFormula{}), 1e-5);
    }
}

TEST(Brick, IsTheMeanOverAPixel) {
    for (const double size : {0.2, 0.7, 1.5, 4.0}) {
        const double u = 0.125 * size, v = 0.06 * size;
        const Image uv = plane(-0.4, 0.3, u, v, 30);
        const Differences d = differences(paint("brick", {}, uv), drawn_finely(uv, u, v, BrickFormula{}));
        EXPECT_LT(d.mean, 0.012) << size;
        EXPECT_LT(d.largest, 0.1) << size;
    }
}

TEST(Brick, IsTheMeanOverALongPixel) {
    const Image uv = plane(0.2, 0.1, 0.001, 1.3, 30);
    const Differences d =
        differences(paint("brick", {}, uv), drawn_finely(uv, 0.001, 1.3, BrickFormula{}, 3, 1000));
    EXPECT_LT(d.mean, 0.03);
    EXPECT_LT(d.largest, 0.12);
}

TEST(Brick, DoesNotSparkleFarAway) {
    EXPECT_GT(deviation(paint("brick", {}, plane(0.1, 0.2, 0.004, 0.003))), 0.1);
    EXPECT_LT(deviation(paint("brick", {}, plane(0.1, 0.2, 0.77, 0.53))), 0.025);
    EXPECT_LT(deviation(paint("brick", {}, plane(0.1, 0.2, 7.7, 5.3))), 0.002);
}

TEST(Brick, ASeamIsNoLargeStep) {
    Image uv = plane(0.3, 0.4, 0.01, 0.01, 20);
    uv.fill("U", [&](int x, int y) { return uv.at("U", x, y) + (x < 12 ? 0 : 9.1); });
    const Image out = paint("brick", {}, uv);
    for (const Rect& side : {Rect{0, 0, 12, 20}, Rect{12, 0, 20, 20}})
        EXPECT_IMAGE(cropped(out, side), paint("brick", {}, cropped(uv, side)));
}

TEST(Brick, IsAsTransparentAsItsCoordinates) {
    Image uv({0, 0, 3, 1}, {"A", "U", "V"});
    for (int x = 0; x < 3; ++x) {
        uv.at("A", x, 0) = 0.5F * static_cast<float>(x);
        uv.at("U", x, 0) = 0.0625F * uv.at("A", x, 0);
        uv.at("V", x, 0) = 0.03125F * uv.at("A", x, 0);
    }
    EXPECT_IMAGE_NEAR(paint("brick", {}, uv), drawn(uv, BrickFormula{}), 1e-6);
    EXPECT_EQ(paint("brick", {}, uv).at("A", 0, 0), 0);
}

std::string uv_error(const Image& uv) {
    try {
        paint("brick", {}, uv);
    } catch (const Failure& f) {
        return f.what();
    }
    return "";
}

TEST(Brick, TakesSAndTToo) {
    Image uv = lonely_points(3), st = uv;
    st.channels[1].name = "S";
    st.channels[2].name = "T";
    EXPECT_IMAGE(paint("brick", {}, st), paint("brick", {}, uv));
    EXPECT_THAT(uv_error(ascii({"."})),
                ::testing::HasSubstr("'uv' needs channels U and V, or S and T; its input has 'Y'"));
}

TEST(Brick, NanIsNan) {
    Image uv({0, 0, 1, 1}, {"U", "V"});
    uv.at("U", 0, 0) = std::numeric_limits<float>::quiet_NaN();
    EXPECT_TRUE(std::isnan(paint("brick", {}, uv).at("R", 0, 0)));
    EXPECT_EQ(paint("brick", {}, uv).at("A", 0, 0), 1);
}

TEST(Brick, DoesNotDependOnTheTile) {
    const Image uv = plate("ViewLayer.UV", {"U", "V", "A"});
    EXPECT_IMAGE(paint("brick", {}, uv, {2, 37}), paint("brick", {}, uv, {1, 1000}));
}

TEST(Brick, AnEmptyWindowStaysEmpty) {
    EXPECT_TRUE(paint("brick", {}, Image({4, 4, 4, 9}, {"U", "V"})).window.empty());
}

}  // namespace
}  // namespace keyline::testing
