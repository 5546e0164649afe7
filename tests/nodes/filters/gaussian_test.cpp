// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/run.h"

#include <algorithm>
#include <cmath>

namespace keyline::testing {
namespace {

// Straight from the definition, in double: the 2-D kernel over what lies inside the window, renormalised.
Image blurred(const Image& in, double sx, double sy) {
    Image out = in;
    const int rx = static_cast<int>(std::ceil(2.5 * sx)), ry = static_cast<int>(std::ceil(2.5 * sy));
    for (Image::Channel& c : out.channels)
        out.fill(c.name, [&](int x, int y) {
            double sum = 0, weights = 0;
            for (int dy = -ry; dy <= ry; ++dy)
                for (int dx = -rx; dx <= rx; ++dx) {
                    if (!in.window.contains(x + dx, y + dy)) continue;
                    const double w = (sx > 0 ? std::exp(-0.5 * dx * dx / (sx * sx)) : 1) *
                                     (sy > 0 ? std::exp(-0.5 * dy * dy / (sy * sy)) : 1);
                    sum += w * static_cast<double>(in.at(c.name, x + dx, y + dy));
                    weights += w;
                }
            return sum / weights;
        });
    return out;
}

TEST(Gaussian, AgreesWithTheDefinition) {
    const Image in = noise({-7, 3, 61, 40}, {"R", "Z"}, 1);
    for (const double sigma : {0.3, 1.0, 1.4, 3.7})
        EXPECT_IMAGE_NEAR(run("gaussian", {{"sigma", sigma}}, in), blurred(in, sigma, sigma), 1e-5);
}

TEST(Gaussian, TakesASigmaForEachAxis) {
    const Image in = noise({0, 0, 40, 30}, {"Y"}, 2);
    EXPECT_IMAGE_NEAR(run("gaussian", {{"sigma", {2.5, 0}}}, in), blurred(in, 2.5, 0), 1e-5);
    EXPECT_IMAGE_NEAR(run("gaussian", {{"sigma", {0, 1.2}}}, in), blurred(in, 0, 1.2), 1e-5);
}

TEST(Gaussian, AWideOneIsTheSameWhateverTheTile) {
    const Image in = noise({-9, 4, 120, 90}, {"Y"}, 5);
    const Image whole = run("gaussian", {{"sigma", 10}}, in, {.tile = 400});
    for (const int tile : {7, 32, 64})
        EXPECT_IMAGE(run("gaussian", {{"sigma", 10}}, in, {.tile = tile}), whole);
}

TEST(Gaussian, ZeroPassesThrough) {
    const Image in = noise({0, 0, 9, 9}, {"Y"}, 3);
    EXPECT_IMAGE(run("gaussian", {{"sigma", 0}}, in), in);
}

TEST(Gaussian, KeepsAConstantToTheLastBitUpToTheEdge) {
    for (const Rect& window : {Rect{5, 5, 90, 30}, Rect{0, 0, 1, 9}, Rect{0, 0, 3, 2}})
        for (const float value : {0.3F, 0.1F, 0.75F, 1e-20F, -40000.0F})
            for (const double sigma : {0.3, 0.5, 1.0, 1.4, 4.0, 11.0}) {
                const Image in = noise(window, {"Y"}, 4, value, value);
                EXPECT_IMAGE(run("gaussian", {{"sigma", sigma}}, in), in);
            }
}

// One of 50 000 beside premultiplied values: nothing of it is lost, and nothing is less than 0.
TEST(Gaussian, AFireflySpreadsAsItShould) {
    Image in = noise({0, 0, 60, 40}, {"R", "A"}, 9);
    in.at("R", 30, 20) = in.at("A", 30, 20) = 50000;
    const Image out = run("gaussian", {{"sigma", 2}}, in);
    EXPECT_IMAGE_AGREES(out, blurred(in, 2, 2), in, 5);
    for (const Image::Channel& c : out.channels) EXPECT_GE(*std::ranges::min_element(c.samples), 0);
}

TEST(Gaussian, RefusesANegativeSigma) {
    EXPECT_EQ(
        error_of("gaussian", {{"sigma", -3}}, ascii({"."})),
        "test.json:5:13: error: node 'node' (gaussian): 'sigma' is -3; it must be from 0 to 500 pixels\n");
}

}  // namespace
}  // namespace keyline::testing
