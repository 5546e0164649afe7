// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/nodes/extrema_reference.h"

namespace keyline::testing {
namespace {

TEST(Erode, ShrinksAMatte) {
    const Image matte = ascii({"......", ".2222.", ".2222.", ".2222.", "......"});
    EXPECT_IMAGE(run("erode", {{"shape", "square"}}, matte),
                 ascii({"......", "......", "..22..", "......", "......"}));
    EXPECT_IMAGE(run("erode", {{"radius", 1.9}, {"shape", "diamond"}}, matte),
                 ascii({"......", "......", "..22..", "......", "......"}));
}

TEST(Erode, DoesNotEatIntoTheEdgeOfTheWindow) {
    EXPECT_IMAGE(run("erode", {{"radius", 2}}, ascii({"55", "55"})), ascii({"55", "55"}));
}

TEST(Erode, PassesOverNan) {
    EXPECT_IMAGE(run("erode", {{"shape", "square"}}, ascii({"x3x9", "xxx7"})), ascii({"3337", "3337"}));
    EXPECT_IMAGE(run("erode", {}, ascii({"xx", "xx"})), ascii({"..", ".."}));
}

TEST(Erode, AgreesOnLines) {
    Image in = lines({-9, 3, 70, 50}, 1);
    for (float& s : in.channels[0].samples) s = 1 - s;
    expect_extremum("erode", in, {1, 1.5, 3, 7.07, 12});
}

TEST(Erode, AgreesOnGreysWithNanAndZerosOfBothSigns) {
    expect_extremum("erode", awkward({-9, 3, 60, 45}, 3), {1, 2.5, 5});
    expect_extremum("erode", awkward({5, -30, 6, 40}, 4), {3, 100});
}

TEST(Erode, AgreesOnARealPlate) {
    expect_extremum("erode", cropped(plate(), {100, 60, 260, 160}), {1.5, 4.25});
}

}  // namespace
}  // namespace keyline::testing
