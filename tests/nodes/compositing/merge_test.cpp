// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/nodes/plate.h"

#include <cmath>
#include <functional>
#include <limits>

namespace keyline::testing {
namespace {

const std::vector<std::string> kRgba{"R", "G", "B", "A"};

// Blends are evaluated the other way round from the node: on straight colour, as W3C Compositing states
// them: α β B(cb, cs) + a (1 − β) + b (1 − α).
using Blend = std::function<double(double cb, double cs)>;

double hard(double cb, double cs) { return cs <= 0.5 ? 2 * cb * cs : 1 - 2 * (1 - cb) * (1 - cs); }

double soft(double cb, double cs) {
    if (cs <= 0.5) return cb - (1 - 2 * cs) * cb * (1 - cb);
    const double d = cb <= 0.25 ? ((16 * cb - 12) * cb + 4) * cb : std::sqrt(cb);
    return cb + (2 * cs - 1) * (d - cb);
}

const std::map<std::string, Blend> kBlends{
    {"multiply", [](double cb, double cs) { return cb * cs; }},
    {"screen", [](double cb, double cs) { return cb + cs - cb * cs; }},
    {"overlay", [](double cb, double cs) { return hard(cs, cb); }},
    {"hardlight", hard},
    {"softlight", soft},
    {"darken", [](double cb, double cs) { return std::min(cb, cs); }},
    {"lighten", [](double cb, double cs) { return std::max(cb, cs); }},
    {"difference", [](double cb, double cs) { return std::abs(cb - cs); }}};

// Porter and Duff's operators, and arithmetic on all four channels.
using Formula = std::function<double(double a, double alpha, double b, double beta)>;

const std::map<std::string, Formula> kFormulas{
    {"over", [](double a, double alpha, double b, double) { return a + b * (1 - alpha); }},
    {"under", [](double a, double, double b, double beta) { return a * (1 - beta) + b; }},
    {"in", [](double a, double, double, double beta) { return a * beta; }},
    {"out", [](double a, double, double, double beta) { return a * (1 - beta); }},
    {"atop", [](double a, double alpha, double b, double beta) { return a * beta + b * (1 - alpha); }},
    {"xor", [](double a, double alpha, double b, double beta) { return a * (1 - beta) + b * (1 - alpha); }},
    {"plus", [](double a, double, double b, double) { return a + b; }},
    {"minus", [](double a, double, double b, double) { return a - b; }},
    {"min", [](double a, double, double b, double) { return std::fmin(a, b); }},
    {"max", [](double a, double, double b, double) { return std::fmax(a, b); }},
    {"divide", [](double a, double, double b, double) { return b == 0 ? 0 : a / b; }},
    {"average", [](double a, double, double b, double) { return (a + b) / 2; }}};

double expected_sample(const std::string& operation, bool is_alpha, double a, double alpha, double b,
                       double beta) {
    if (const auto f = kFormulas.find(operation); f != kFormulas.end()) return f->second(a, alpha, b, beta);
    if (is_alpha) return alpha + beta - alpha * beta;
    const double cs = alpha == 0 ? 0 : a / alpha, cb = beta == 0 ? 0 : b / beta;
    return alpha * beta * kBlends.at(operation)(cb, cs) + a * (1 - beta) + b * (1 - alpha);
}

Image expected(const std::string& operation, const Image& a, const Image& b) {
    Image out(unite(a.window, b.window), kRgba);
    out.display = b.display;
    for (const std::string& c : kRgba)
        out.fill(c, [&](int x, int y) {
            return expected_sample(operation, c == "A", double{a.at(c, x, y)}, double{a.at("A", x, y)},
                                   double{b.at(c, x, y)}, double{b.at("A", x, y)});
        });
    return out;
}

// Premultiplied colour: transparent, half-covered and opaque pixels, some brighter than white.
Image premultiplied(const Rect& window, unsigned seed) {
    Image image = noise(window, kRgba, seed, 0, 1.25F);
    image.fill("A", [&](int x, int y) {
        const float a = image.at("A", x, y);
        return a < 0.2F ? 0 : std::min(a, 1.0F);
    });
    for (const char* c : {"R", "G", "B"})
        image.fill(c, [&](int x, int y) { return image.at(c, x, y) * image.at("A", x, y); });
    return image;
}

TEST(Merge, AgreesWithTheFormulas) {
    const Image a = premultiplied({-3, 4, 30, 25}, 1), b = premultiplied({5, -2, 44, 21}, 2);
    std::vector<std::string> operations;
    for (const auto& [name, f] : kFormulas) operations.push_back(name);
    for (const auto& [name, f] : kBlends) operations.push_back(name);
    ASSERT_EQ(operations.size(), 20);
    for (const std::string& operation : operations) {
        SCOPED_TRACE(operation);
        // A quotient may be large: 1e-5 of it is what is asked for.
        EXPECT_IMAGE_NEAR(run("merge", {{"operation", operation}}, {{"a", a}, {"b", b}}),
                          expected(operation, a, b), operation == "divide" ? 1e-2 : 1e-5);
    }
}

TEST(Merge, WorksOnARender) {
    const Image b = plate("ViewLayer.Combined", kRgba, 16);
    const Image a = premultiplied({100, 50, 300, 200}, 3);
    for (const char* operation : {"over", "softlight", "screen"})
        EXPECT_IMAGE_NEAR(run("merge", {{"operation", operation}}, {{"a", a}, {"b", b}}),
                          expected(operation, a, b), 16e-5);
}

TEST(Merge, AnInputWithoutAlphaIsOpaqueInsideItsWindow) {
    Image a({0, 0, 2, 1}, {"R", "G", "B"});
    a.at("R", 0, 0) = 0.25F;
    const Image b = premultiplied({0, 0, 3, 2}, 4);
    const Image out = run("merge", {}, {{"a", a}, {"b", b}});
    EXPECT_EQ(out.at("R", 0, 0), 0.25F);
    EXPECT_EQ(out.at("A", 1, 0), 1);
    EXPECT_EQ(out.at("A", 2, 0), b.at("A", 2, 0));
}

TEST(Merge, MixAndMaskLeadBackToB) {
    const Image a = premultiplied({0, 0, 9, 5}, 5), b = premultiplied({0, 0, 9, 5}, 6);
    const Image mask = noise({2, 0, 9, 5}, {"Y"}, 7);
    const Image whole = expected("screen", a, b);
    Image mixed = b;
    for (const std::string& c : kRgba)
        mixed.fill(c, [&](int x, int y) {
            const double k = 0.5 * double{mask.at("Y", x, y)};
            return double{b.at(c, x, y)} * (1 - k) + double{whole.at(c, x, y)} * k;
        });
    EXPECT_IMAGE_NEAR(
        run("merge", {{"operation", "screen"}, {"mix", 0.5}}, {{"a", a}, {"b", b}, {"mask", mask}}), mixed,
        1e-6);
}

TEST(Merge, NothingIsLeftOfTheChangeAtMixZero) {
    Image a = premultiplied({0, 0, 4, 4}, 8);
    a.at("R", 1, 1) = std::numeric_limits<float>::quiet_NaN();
    const Image b = premultiplied({0, 0, 4, 4}, 9);
    EXPECT_IMAGE(run("merge", {{"mix", 0}}, {{"a", a}, {"b", b}}), b);
}

TEST(Merge, MinAndMaxPassOverNan) {
    Image a = premultiplied({0, 0, 2, 1}, 10), b = premultiplied({0, 0, 2, 1}, 11);
    a.at("R", 0, 0) = b.at("R", 1, 0) = std::numeric_limits<float>::quiet_NaN();
    for (const char* operation : {"min", "max"}) {
        const Image out = run("merge", {{"operation", operation}}, {{"a", a}, {"b", b}});
        EXPECT_EQ(out.at("R", 0, 0), b.at("R", 0, 0));
        EXPECT_EQ(out.at("R", 1, 0), a.at("R", 1, 0));
    }
}

TEST(Merge, OtherChannelsOfBPass) {
    Image b = premultiplied({0, 0, 3, 1}, 12);
    b.channels.push_back({"depth.Z", SampleType::kFloat, {7, 8, 9}});
    const Image out = run("merge", {}, {{"a", premultiplied({-1, 0, 1, 1}, 13)}, {"b", b}});
    EXPECT_EQ(out.at("depth.Z", 2, 0), 9);
    EXPECT_EQ(out.at("depth.Z", -1, 0), 0);
}

}  // namespace
}  // namespace keyline::testing
