// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/cryptomatte.h"
#include "tests/support/run.h"

#include <bit>
#include <fmt/format.h>

namespace keyline::testing {
namespace {

// Four pixels: the ball; half the ball, a quarter the box and an eighth nothing in the manifest; the box's
// three quarters; nothing.
Image objects(bool with_manifest = true) {
    const auto id = [](const char* name) { return std::bit_cast<float>(cryptomatte_id(name)); };
    Image image({3, -2, 7, -1},
                {"Crypto00.r", "Crypto00.g", "Crypto00.b", "Crypto00.a", "Crypto01.r", "Crypto01.g"});
    image.channels[0].samples = {id("ball"), id("ball"), id("box"), 0};
    image.channels[1].samples = {1, 0.5F, 0.75F, 0};
    image.channels[2].samples = {0, id("box"), 0, 0};
    image.channels[3].samples = {0, 0.25F, 0, 0};
    image.channels[4].samples = {0, id("stranger"), 0, 0};
    image.channels[5].samples = {0, 0.125F, 0, 0};
    image.metadata.set({"cryptomatte/abc/name", "string", std::string("Crypto")});
    if (with_manifest)
        image.metadata.set({"cryptomatte/abc/manifest", "string",
                            fmt::format(R"({{"ball":"{:08x}","box":"{:08x}"}})", cryptomatte_id("ball"),
                                        cryptomatte_id("box"))});
    return image;
}

using Samples = std::vector<float>;

TEST(Palette, EachObjectHasItsColourByHowMuchItCovers) {
    const Image out = run("palette", {{"colors", {{"ball", {1, 0.5, 0.25}}, {"box", {0, 2, 4}}}}}, objects());
    EXPECT_EQ(out.channel("R").samples, (Samples{1, 0.5F, 0, 0}));
    EXPECT_EQ(out.channel("G").samples, (Samples{0.5F, 0.25F + 0.5F, 1.5F, 0}));
    EXPECT_EQ(out.channel("B").samples, (Samples{0.25F, 0.125F + 1, 3, 0}));
    EXPECT_EQ(out.channel("A").samples, (Samples{1, 0.75F, 0.75F, 0}));
}

TEST(Palette, NumbersMakeOneChannel) {
    const Image out = run("palette", {{"values", {{"ball", 8}, {"box", -4}}}}, objects());
    ASSERT_EQ(out.channels.size(), 1U);
    EXPECT_EQ(out.channel("value").samples, (Samples{8, 3, -3, 0}));
}

TEST(Palette, TheFirstPatternThatMatchesCounts) {
    const auto values = [](const Json& table) {
        return run("palette", {{"values", table}}, objects()).channel("value").samples;
    };
    EXPECT_EQ(values({{"b*", 1}, {"box", 8}}), (Samples{1, 0.75F, 0.75F, 0}));
    EXPECT_EQ(values({{"box", 8}, {"b*", 1}}), (Samples{1, 2.5F, 6, 0}));
    // What the manifest does not know is for "*" alone, and so is an image without one.
    EXPECT_EQ(values({{"box", 8}, {"*", 1}}), (Samples{1, 2.625F, 6, 0}));
}

TEST(Palette, WithoutAManifestNamesAreHashed) {
    const Json table{{"box", 8}, {"*", 1}};
    EXPECT_EQ(run("palette", {{"values", table}}, objects(false)).channel("value").samples,
              (Samples{1, 2.625F, 6, 0}));
    EXPECT_NE(error_of("palette", {{"values", {{"b*", 1}}}}, objects(false))
                  .find("the input has no manifest to look 'b*' up in; give whole names"),
              std::string::npos);
}

}  // namespace
}  // namespace keyline::testing
