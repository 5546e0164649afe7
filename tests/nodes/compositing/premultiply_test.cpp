// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/run.h"

#include <cmath>
#include <limits>

namespace keyline::testing {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// The same channels with R G B made from each and the A at the pixel.
template <class F>
Image recoloured(const Image& in, F f) {
    Image out = in;
    for (const char* c : {"R", "G", "B"})
        out.fill(c, [&](int x, int y) { return f(double{in.at(c, x, y)}, double{in.at("A", x, y)}); });
    return out;
}

TEST(Premultiply, MultipliesColourAndPassesTheRest) {
    const Image in = noise({-5, 2, 42, 33}, {"R", "G", "B", "A", "Z"}, 1, -1, 4);
    EXPECT_IMAGE_NEAR(run("premultiply", {}, in), recoloured(in, [](double c, double a) { return c * a; }),
                      1e-5);
}

TEST(Unpremultiply, DividesColourAndMakesItZeroWhereThereIsNone) {
    Image in = noise({3, -7, 40, 21}, {"A", "R", "G", "B", "id"}, 2, 0.25F, 4);
    in.at("A", 3, -7) = 0;
    in.at("A", 10, 4) = -0.0F;
    EXPECT_IMAGE_NEAR(run("unpremultiply", {}, in),
                      recoloured(in, [](double c, double a) { return a == 0 ? 0 : c / a; }), 1e-5);
}

TEST(Unpremultiply, NanStaysWhereItIs) {
    Image in({0, 0, 3, 1}, {"R", "G", "B", "A"});
    in.fill("A", [](int, int) { return 1; });
    in.at("R", 1, 0) = kNan;
    in.at("A", 2, 0) = kNan;
    const Image out = run("unpremultiply", {}, in);
    EXPECT_EQ(out.at("R", 0, 0), 0);
    EXPECT_TRUE(std::isnan(out.at("R", 1, 0)));
    EXPECT_EQ(out.at("G", 1, 0), 0);
    EXPECT_TRUE(std::isnan(out.at("G", 2, 0)));
}

TEST(Premultiply, NeedsAnA) {
    const std::string error = error_of("premultiply", {}, Image({0, 0, 1, 1}, {"R", "G", "B"}));
    EXPECT_NE(error.find("'A'"), std::string::npos) << error;
}

}  // namespace
}  // namespace keyline::testing
