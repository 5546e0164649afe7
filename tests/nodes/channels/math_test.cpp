// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/nodes/plate.h"

#include <cmath>
#include <functional>

namespace keyline::testing {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

template <class F>
Image each(const Image& in, F f) {
    Image out = in;
    for (Image::Channel& c : out.channels)
        for (float& s : c.samples) s = static_cast<float>(f(double{s}));
    return out;
}

TEST(Math, AgreesWithTheFormulasOnANumber) {
    const std::map<std::string, std::function<double(double)>> formulas{{"add", [](double v) { return v + 0.7; }},
                                                                        {"subtract", [](double v) { return v - 0.7; }},
                                                                        {"multiply", [](double v) { return v * 0.7; }},
                                                                        {"divide", [](double v) { return v / 0.7; }},
                                                                        {"min", [](double v) { return std::min(v, 0.7); }},
                                                                        {"max", [](double v) { return std::max(v, 0.7); }},
                                                                        {"power", [](double v) { return std::pow(v, 0.7); }}};
    const Image in = noise({-4, 9, 35, 20}, {"Y", "Z"}, 1, 0, 3);
    for (const auto& [op, f] : formulas) {
        SCOPED_TRACE(op);
        EXPECT_IMAGE_NEAR(run("math", {{"op", op}, {"value", 0.7}}, in), each(in, f), 3e-6);
    }
}

TEST(Math, AgreesWithTheFormulasOfOneOperand) {
    const std::map<std::string, std::function<double(double)>> formulas{{"reciprocal", [](double v) { return 1 / v; }},
                                                                        {"abs", [](double v) { return std::abs(v); }},
                                                                        {"negate", [](double v) { return -v; }},
                                                                        {"invert", [](double v) { return 1 - v; }},
                                                                        {"sqrt", [](double v) { return std::sqrt(v); }},
                                                                        {"exp", [](double v) { return std::exp(v); }},
                                                                        {"log", [](double v) { return std::log(v); }},
                                                                        {"clamp", [](double v) { return std::clamp(v, 0.0, 1.0); }}};
    const Image in = noise({0, 0, 41, 13}, {"Y"}, 2, -2, 3);
    for (const auto& [op, f] : formulas) {
        SCOPED_TRACE(op);
        const bool of_positive = op == "sqrt" || op == "log" || op == "reciprocal";
        const Image from = of_positive ? each(in, [](double v) { return std::abs(v) + 0.01; }) : in;
        EXPECT_IMAGE_NEAR(run("math", {{"op", op}}, from), each(from, f), 1e-5);
    }
}

TEST(Math, TakesASecondImageByNameOrASingleChannel) {
    const Image a = noise({0, 0, 9, 7}, {"R", "G"}, 3), one = noise({2, 1, 12, 5}, {"Y"}, 4);
    const Image both = noise({0, 0, 9, 7}, {"G", "Z", "R"}, 5);
    const Image sum = run("math", {{"op", "add"}}, {{"in", a}, {"b", one}});
    EXPECT_EQ(sum.window, (Rect{0, 0, 12, 7}));
    EXPECT_EQ(sum.at("G", 3, 2), a.at("G", 3, 2) + one.at("Y", 3, 2));
    EXPECT_EQ(sum.at("R", 11, 2), one.at("Y", 11, 2));
    const Image product = run("math", {{"op", "multiply"}}, {{"in", a}, {"b", both}});
    EXPECT_EQ(product.at("R", 8, 6), a.at("R", 8, 6) * both.at("R", 8, 6));
    EXPECT_EQ(product.channels.size(), 2);
}

TEST(Math, DividingByNothingGivesNothing) {
    Image in({0, 0, 4, 1}, {"Z"});
    in.channel("Z").samples = {0, -0.0F, kInfinity, kNan};
    const Image out = run("math", {{"op", "reciprocal"}}, in);
    EXPECT_EQ(out.at("Z", 0, 0), 0);
    EXPECT_EQ(out.at("Z", 1, 0), 0);
    EXPECT_EQ(out.at("Z", 2, 0), 0);
    EXPECT_TRUE(std::isnan(out.at("Z", 3, 0)));
    EXPECT_EQ(run("math", {{"op", "divide"}, {"value", 0}}, ascii({"2"})).at("Y", 0, 0), 0);
}

TEST(Math, MinimaPassOverNan) {
    EXPECT_IMAGE(run("math", {{"op", "min"}, {"value", 3}}, ascii({"x25"})), ascii({"323"}));
    EXPECT_IMAGE(run("math", {{"op", "max"}, {"value", 3}}, ascii({"x25"})), ascii({"335"}));
}

TEST(Math, MixesAndMasks) {
    const Image out = run("math", {{"op", "add"}, {"value", 4}, {"mix", 0.5}},
                          {{"in", ascii({"123"})}, {"mask", ascii({".1"})}});
    EXPECT_IMAGE(out, ascii({"143"}));
}

TEST(Math, RefusesTheWrongNumberOfOperands) {
    const Image in = ascii({"1"});
    EXPECT_NE(error_of("math", {{"op", "add"}}, in).find("neither 'value' nor 'b'"), std::string::npos);
    EXPECT_NE(error_of("math", {{"op", "abs"}, {"value", 1}}, in).find("no second operand"),
              std::string::npos);
}

// A plane seen in perspective: 1/Z is linear on it.
TEST(Math, LaplacianOfTheReciprocalIsZeroOnPlanes) {
    Image depth({-3, 5, 60, 44}, {"Z"});
    depth.fill("Z", [](int x, int y) { return 1 / (0.02 + 0.001 * x + 0.0007 * y); });
    const Image out = run_graph({{"r", {{"type", "math"}, {"in", "depth"}, {"op", "reciprocal"}}},
                                 {"l", {{"type", "laplacian"}, {"in", "r"}}}},
                                "l", std::map<std::string, Image>{{"depth", depth}});
    for (int y = 6; y < 43; ++y)
        for (int x = -2; x < 59; ++x) ASSERT_NEAR(out.at("Z", x, y), 0, 5e-8) << x << ',' << y;
}

}  // namespace
}  // namespace keyline::testing
