// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/nodes/plate.h"

namespace keyline::testing {
namespace {

Image stepped(const Image& in, double low, double high) {
    Image out = in;
    for (Image::Channel& c : out.channels)
        for (float& s : c.samples) {
            const double t = low == high ? (double{s} >= low ? 1 : 0)
                                         : std::clamp((double{s} - low) / (high - low), 0.0, 1.0);
            s = static_cast<float>(t * t * (3 - 2 * t));
        }
    return out;
}

TEST(Threshold, IsASmoothStep) {
    const Image in = noise({-7, 3, 30, 21}, {"Y", "Z"}, 1, -1, 2);
    EXPECT_IMAGE_NEAR(run("threshold", {{"low", 0.25}, {"high", 0.75}}, in), stepped(in, 0.25, 0.75), 1e-6);
    EXPECT_IMAGE_NEAR(run("threshold", {{"low", 0.49}, {"high", 0.51}}, in), stepped(in, 0.49, 0.51), 1e-6);
}

TEST(Threshold, IsHardWithoutHigh) {
    EXPECT_IMAGE(run("threshold", {{"low", 3}}, ascii({"12345x"})), ascii({"..111."}));
    const Image in = plate("ViewLayer.Combined", {"R", "G", "B"});
    EXPECT_IMAGE(run("threshold", {{"low", 0.18}}, in), stepped(in, 0.18, 0.18));
}

TEST(Threshold, NanIsBelowEverything) {
    EXPECT_IMAGE(run("threshold", {{"low", 1}, {"high", 2}}, ascii({"x2"})), ascii({".1"}));
}

TEST(Threshold, RefusesAFallingStep) {
    const std::string error = error_of("threshold", {{"low", 1}, {"high", 0.5}}, ascii({"1"}));
    EXPECT_NE(error.find("'high' is 0.5, below 'low', 1"), std::string::npos) << error;
}

}  // namespace
}  // namespace keyline::testing
