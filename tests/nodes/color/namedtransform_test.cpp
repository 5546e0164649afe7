// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/run.h"

namespace keyline::testing {
namespace {

Image grey() {
    Image image({0, 0, 3, 1}, {"R", "G", "B", "depth.Z"});
    for (Image::Channel& c : image.channels) c.samples = {0, 0.5F, 1};
    return image;
}

TEST(NamedTransform, AppliesWhatTheConfigCallsSo) {
    const Image out = run("namedtransform", {{"transform", "sRGB - Curve"}}, grey());
    EXPECT_NEAR(out.at("G", 1, 0), 0.21404, 1e-4);
    EXPECT_EQ(out.channel("depth.Z").samples, grey().channel("depth.Z").samples);
    const Image back = run("namedtransform", {{"transform", "srgb_crv"}, {"inverse", true}}, out);
    EXPECT_NEAR(back.at("G", 1, 0), 0.5, 1e-5);
}

TEST(NamedTransform, TellsANameThatIsNotThere) {
    EXPECT_NE(error_of("namedtransform", {{"transform", "sRGB - Curv"}}, grey())
                  .find("there is no named transform 'sRGB - Curv' in the built-in OCIO config; it has 'sRGB "
                        "- Curve' "
                        "and 'Rec.1886 - Curve'; did you mean 'sRGB - Curve'?"),
              std::string::npos);
}

}  // namespace
}  // namespace keyline::testing
