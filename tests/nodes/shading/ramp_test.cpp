// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/nodes/plate.h"

#include <cmath>

namespace keyline::testing {
namespace {

double smoothstep(double from, double to, double x) {
    if (from == to) return x >= to ? 1 : 0;
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

// Stops of 0.1 at 0, 0.5 at 0.3, 0.2 at 0.7.
double bands(double x, double softness) {
    if (std::isnan(x)) return 0.1;
    const double s = softness / 2;
    return 0.1 + 0.4 * smoothstep(0.3 - s, 0.3 + s, x) - 0.3 * smoothstep(0.7 - s, 0.7 + s, x);
}

double gradient(double x, bool smooth) {
    if (x < 0 || std::isnan(x)) return 0.1;
    if (x >= 0.7) return 0.2;
    const double t = x < 0.3 ? x / 0.3 : (x - 0.3) / 0.4, w = smooth ? t * t * (3 - 2 * t) : t;
    return x < 0.3 ? 0.1 + 0.4 * w : 0.5 - 0.3 * w;
}

template <class F>
Image looked_up(const Image& in, F f) {
    Image out = in;
    out.channels[0].name = "Y";
    for (float& s : out.channels[0].samples) s = static_cast<float>(f(double{s}));
    return out;
}

const Json kStops{{0, 0.1}, {0.3, 0.5}, {0.7, 0.2}};

TEST(Ramp, AgreesWithTheFormulas) {
    Image in = noise({-5, 3, 41, 30}, {"light"}, 1, -0.5F, 1.5F);
    in.at("light", 0, 5) = std::numeric_limits<float>::quiet_NaN();
    for (const double softness : {0.0, 0.05, 0.6})
        EXPECT_IMAGE_NEAR(run("ramp", {{"stops", kStops}, {"softness", softness}}, in),
                          looked_up(in, [&](double x) { return bands(x, softness); }), 1e-6);
    for (const bool smooth : {false, true})
        EXPECT_IMAGE_NEAR(
            run("ramp", {{"stops", kStops}, {"interpolation", smooth ? "smooth" : "linear"}}, in),
            looked_up(in, [&](double x) { return gradient(x, smooth); }), 1e-6);
}

TEST(Ramp, AStopHoldsFromItsPositionOn) {
    const Image out = run("ramp", {{"stops", {{2, 1}, {4, 3}, {5, 9}}}}, ascii({"0123456x"}));
    EXPECT_IMAGE(out, ascii({"11113991"}));
}

TEST(Ramp, OneColourMakesItColour) {
    const Image out = run("ramp", {{"stops", {{0, 0.25}, {1, {1, 0.5, 0}}}}}, ascii({"01"}));
    ASSERT_EQ(out.channels.size(), 3U);
    EXPECT_EQ(out.channel("R").samples, (std::vector<float>{0.25F, 1}));
    EXPECT_EQ(out.channel("G").samples, (std::vector<float>{0.25F, 0.5F}));
    EXPECT_EQ(out.channel("B").samples, (std::vector<float>{0.25F, 0}));
    EXPECT_EQ(run("ramp", {{"stops", {{0, "#ffffff"}}}}, ascii({"0"})).at("G", 0, 0), 1);
}

TEST(Ramp, MakesBandsOfARender) {
    const Image in = plate("ViewLayer.DiffCol", {"R"});
    EXPECT_IMAGE_NEAR(run("ramp", {{"stops", kStops}}, in),
                      looked_up(in, [](double x) { return bands(x, 0); }), 1e-7);
}

TEST(Ramp, SaysWhatIsWrongWithItsStops) {
    const Image in = ascii({"0"});
    EXPECT_NE(error_of("ramp", {{"stops", Json::array()}}, in).find("there are no stops"), std::string::npos);
    EXPECT_NE(error_of("ramp", {{"stops", {{1, 0}, {0.5, 1}}}}, in).find("at 0.5 follows the one at 1"),
              std::string::npos);
    EXPECT_NE(error_of("ramp", {{"stops", {{1, "x", 2}}}}, in).find("a list of a number and"),
              std::string::npos);
}

}  // namespace
}  // namespace keyline::testing
