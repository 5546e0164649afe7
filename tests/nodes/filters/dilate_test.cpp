// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/nodes/extrema_reference.h"

#include <gmock/gmock.h>

namespace keyline::testing {
namespace {

Image grown(double radius, const char* shape) {
    return run("dilate", {{"radius", radius}, {"shape", shape}},
               ascii({".....", ".....", "..2..", ".....", "....."}));
}

TEST(Dilate, GrowsADotIntoTheBrush) {
    EXPECT_IMAGE(grown(1, "square"), ascii({".....", ".222.", ".222.", ".222.", "....."}));
    EXPECT_IMAGE(grown(1, "disk"), ascii({".....", "..2..", ".222.", "..2..", "....."}));
    EXPECT_IMAGE(grown(2, "diamond"), ascii({"..2..", ".222.", "22222", ".222.", "..2.."}));
}

TEST(Dilate, RadiusIsARealNumber) {
    EXPECT_IMAGE(grown(1.99, "square"), grown(1, "square"));
    EXPECT_IMAGE(grown(1.41, "disk"), grown(1, "disk"));
    EXPECT_IMAGE(grown(1.42, "disk"), grown(1, "square"));
    EXPECT_IMAGE(grown(2.2, "disk"), ascii({"..2..", ".222.", "22222", ".222.", "..2.."}));
    EXPECT_IMAGE(grown(2.24, "disk"), ascii({".222.", "22222", "22222", "22222", ".222."}));
}

TEST(Dilate, ZeroPassesThrough) {
    const Image in = noise({0, 0, 9, 9}, {"Y"}, 1);
    EXPECT_IMAGE(run("dilate", {{"radius", 0}}, in), in);
    EXPECT_IMAGE(run("dilate", {{"radius", 0.9}}, in), in);
}

TEST(Dilate, OutsideTheWindowIsNothingNotZero) {
    Image in({3, 3, 6, 5}, {"Y"});
    in.fill("Y", [](int x, int) { return x - 9; });
    EXPECT_EQ(run("dilate", {{"radius", 4}}, in).channel("Y").samples,
              (std::vector<float>{-4, -4, -4, -4, -4, -4}));
}

TEST(Dilate, PassesOverNan) {
    EXPECT_IMAGE(run("dilate", {{"shape", "square"}}, ascii({"x1x.", "xxx3"})), ascii({"1133", "1133"}));
    EXPECT_IMAGE(run("dilate", {}, ascii({"xx", "xx"})), ascii({"..", ".."}));
}

TEST(Dilate, AgreesOnLines) {
    expect_extremum("dilate", lines({-9, 3, 70, 50}, 1), {1, 1.5, 3, 7.07, 12});
    expect_extremum("dilate", lines({4, 4, 5, 60}, 2), {2, 30});
}

TEST(Dilate, AgreesOnGreysWithNanAndZerosOfBothSigns) {
    expect_extremum("dilate", awkward({-9, 3, 60, 45}, 3), {1, 2.5, 5});
    expect_extremum("dilate", awkward({-30, -1, 40, 0}, 4), {3, 100});
}

TEST(Dilate, AgreesOnARealPlate) {
    expect_extremum("dilate", cropped(plate(), {100, 60, 260, 160}), {1.5, 4.25});
    expect_extremum("dilate", cropped(only(plate("Depth"), {"Z"}), {200, 90, 300, 190}), {3});
}

TEST(Dilate, RefusesANegativeRadius) {
    EXPECT_THAT(error_of("dilate", {{"radius", -0.5}}, ascii({"."})),
                ::testing::HasSubstr("'radius' is -0.5"));
    EXPECT_THAT(error_of("dilate", {{"shape", "disc"}}, ascii({"."})),
                ::testing::HasSubstr("did you mean 'disk'?"));
}

}  // namespace
}  // namespace keyline::testing
