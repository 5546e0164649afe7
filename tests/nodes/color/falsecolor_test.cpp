// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/false_color.h"
#include "tests/support/run.h"

#include <bit>
#include <cmath>
#include <gtest/gtest.h>

namespace keyline::testing {
namespace {

constexpr Rect kWindow{0, 0, 4, 1};

Image row(const std::string& name, std::initializer_list<double> samples) {
    Image image(kWindow, {name});
    image.fill(name, [&](int x, int) { return samples.begin()[x]; });
    return image;
}

std::array<float, 3> at(const Image& image, int x) {
    return {image.at("R", x, 0), image.at("G", x, 0), image.at("B", x, 0)};
}
using Rgb = std::array<float, 3>;

TEST(FalseColor, OfAMatteIsTheMatte) {
    const Image out = run("falsecolor", {}, row("edge", {0, 0.25, 1, 0.5}));
    EXPECT_EQ(at(out, 1), (Rgb{0.25F, 0.25F, 0.25F}));
    EXPECT_EQ(at(out, 2), (Rgb{1, 1, 1}));
}

TEST(FalseColor, GoesFromTheLeastToTheLargest) {
    const Image out = run("falsecolor", {}, row("edge", {-2, 0, 2, 6}));
    EXPECT_EQ(at(out, 0), (Rgb{0, 0, 0}));
    EXPECT_EQ(at(out, 1), (Rgb{0.25F, 0.25F, 0.25F}));
    EXPECT_EQ(at(out, 3), (Rgb{1, 1, 1}));
}

TEST(FalseColor, OrOverARange) {
    const Image out = run("falsecolor", {{"range", {0, 4}}}, row("edge", {-2, 1, 2, 6}));
    EXPECT_EQ(at(out, 0), (Rgb{0, 0, 0}));
    EXPECT_EQ(at(out, 1), (Rgb{0.25F, 0.25F, 0.25F}));
    EXPECT_EQ(at(out, 3), (Rgb{1, 1, 1}));
}

TEST(FalseColor, NanCantBeOverlooked) {
    EXPECT_EQ(at(run("falsecolor", {}, row("edge", {0, 1, NAN, 0.5})), 2), (Rgb{1, 0, 1}));
}

// Renderers write 1e10 where there is nothing: it does not take the whole range.
TEST(FalseColor, OfDepthIsLightWhereItIsNear) {
    const Image out = run("falsecolor", {}, row("Depth.Z", {10, 15, 20, 1e10}));
    EXPECT_EQ(at(out, 0), (Rgb{1, 1, 1}));
    EXPECT_EQ(at(out, 1), (Rgb{0.5F, 0.5F, 0.5F}));
    EXPECT_EQ(at(out, 2), (Rgb{0, 0, 0}));
    EXPECT_EQ(at(out, 3), (Rgb{0, 0, 0}));
}

TEST(FalseColor, OfWhatWasMadeOfADepthIsANumberLikeOthers) {
    const Json nodes{{"n", {{"type", "math"}, {"op", "negate"}, {"in", "d"}}},
                     {"f", {{"type", "falsecolor"}, {"in", "n"}}}};
    const Image out = run_graph(nodes, "f", {{"d", row("Depth.Z", {10, 15, 20, 12})}});
    EXPECT_EQ(at(out, 0), (Rgb{1, 1, 1}));
    EXPECT_EQ(at(out, 2), (Rgb{0, 0, 0}));
}

TEST(FalseColor, OfVectorsLiesAroundGrey) {
    Image normals(kWindow, {"N.X", "N.Y", "N.Z"});
    normals.at("N.X", 0, 0) = 1;
    normals.at("N.Y", 1, 0) = -0.5F;
    EXPECT_EQ(at(run("falsecolor", {}, normals), 0), (Rgb{1, 0.5F, 0.5F}));
    EXPECT_EQ(at(run("falsecolor", {}, normals), 1), (Rgb{0.5F, 0.25F, 0.5F}));
    Image places = normals;
    places.at("N.Z", 2, 0) = -10;
    EXPECT_EQ(at(run("falsecolor", {}, places), 2), (Rgb{0.5F, 0.5F, 0}));
}

TEST(FalseColor, OfASlopeIsItsDirection) {
    Image slope(kWindow, {"dx", "dy", "magnitude"});
    slope.at("dx", 0, 0) = 2;
    slope.at("dy", 1, 0) = -1;
    EXPECT_EQ(at(run("falsecolor", {}, slope), 0), (Rgb{1, 0.5F, 0.5F}));
    EXPECT_EQ(at(run("falsecolor", {}, slope), 1), (Rgb{0.5F, 0.25F, 0.5F}));
}

TEST(FalseColor, OfIdsIsAColourEach) {
    const Image out = run("falsecolor", {}, row("objectid", {0, 1, 2, 1}));
    EXPECT_EQ(at(out, 0), (Rgb{0, 0, 0}));
    EXPECT_EQ(at(out, 1), at(out, 3));
    EXPECT_NE(at(out, 1), at(out, 2));
    EXPECT_EQ(at(out, 1), colour_of_id(std::bit_cast<uint32_t>(1.0F)));
}

TEST(FalseColor, OfACryptomatteMixesByCoverage) {
    Image crypto(kWindow, {"Crypto00.R", "Crypto00.G", "Crypto00.B", "Crypto00.A"});
    const auto a = std::bit_cast<float>(0x41234567U), b = std::bit_cast<float>(0x31234567U);
    crypto.fill("Crypto00.R", [&](int, int) { return a; });
    crypto.fill("Crypto00.G", [](int x, int) { return x == 0 ? 1 : 0.5; });
    crypto.fill("Crypto00.B", [&](int, int) { return b; });
    crypto.fill("Crypto00.A", [](int x, int) { return x == 0 ? 0 : 0.5; });
    const Image out = run("falsecolor", {}, crypto);
    const Rgb of_a = colour_of_id(0x41234567U), of_b = colour_of_id(0x31234567U);
    EXPECT_EQ(at(out, 0), of_a);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(at(out, 1)[c], 0.5F * of_a[c] + 0.5F * of_b[c]);
}

TEST(FalseColor, OfColourIsWhatADisplayShows) {
    Image colour(kWindow, {"R", "G", "B"});
    for (const char* c : {"R", "G", "B"}) colour.fill(c, [](int x, int) { return x * 0.3; });
    EXPECT_IMAGE(run("falsecolor", {}, colour), run("display", {}, colour));
    EXPECT_IMAGE(run("falsecolor", {{"referred", "display"}}, colour), colour);
}

TEST(FalseColor, WhatCanBeSeenThroughLiesOverABoard) {
    Image ink(kWindow, {"R", "G", "B", "A"});
    ink.at("A", 0, 0) = 1;
    const Image out = run("falsecolor", {}, ink);
    EXPECT_NEAR(double{out.at("R", 0, 0)}, 0, 1e-6);
    EXPECT_NEAR(double{out.at("R", 1, 0)}, 0.66, 1e-6);
}

// Colour goes before data, wherever it stands.
TEST(FalseColor, TakesTheColourOfManyLayers) {
    Image all(kWindow, {"Depth.Z", "Diffuse.R", "Diffuse.G", "Diffuse.B", "N.X", "N.Y", "N.Z"});
    all.fill("Diffuse.R", [](int, int) { return 1; });
    const Rgb first = at(run("falsecolor", {}, all), 0);
    EXPECT_GT(first[0], 0.7F);
    EXPECT_LT(first[1], 0.5F);
}

TEST(FalseColor, ARangeIsNotEmpty) {
    EXPECT_NE(error_of("falsecolor", {{"range", {1, 1}}}, row("Y", {0, 0, 0, 0})).find("the smaller first"),
              std::string::npos);
}

}  // namespace
}  // namespace keyline::testing
