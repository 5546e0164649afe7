// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/run.h"

#include <gmock/gmock.h>

namespace keyline::testing {
namespace {

using ::testing::Each;
using ::testing::HasSubstr;

Image constant(const Json& params, const std::map<std::string, Image>& inputs = {}) {
    return run("constant", params, inputs);
}

TEST(Constant, IsOpaqueOfThreeNumbers) {
    const Image out = constant({{"color", {0.5, -1, 100}}, {"size", {7, 5}}});
    EXPECT_EQ(out.window, (Rect{0, 0, 7, 5}));
    EXPECT_EQ(out.display, (Rect{0, 0, 7, 5}));
    EXPECT_THAT(out.channel("R").samples, Each(0.5F));
    EXPECT_THAT(out.channel("G").samples, Each(-1.0F));
    EXPECT_THAT(out.channel("B").samples, Each(100.0F));
    EXPECT_THAT(out.channel("A").samples, Each(1.0F));
}

TEST(Constant, FourNumbersArePremultiplied) {
    const Image out = constant({{"color", {0.5, 0.25, 0, 0.5}}, {"size", {2, 2}}});
    EXPECT_THAT(out.channel("R").samples, Each(0.5F));
    EXPECT_THAT(out.channel("A").samples, Each(0.5F));
}

// The data window reaches over the display window: what another is cut to says nothing of a constant.
TEST(Constant, TakesTheWindowsOfAnother) {
    Image like = noise({-3, 4, 9, 11}, {"Z"}, 1);
    like.display = {0, 0, 6, 6};
    const Image out = constant({{"color", "#ffffff"}}, {{"like", like}});
    EXPECT_EQ(out.window, (Rect{-3, 0, 9, 11}));
    EXPECT_EQ(out.display, like.display);
    EXPECT_EQ(out.channels.size(), 4U);
    EXPECT_FALSE(out.has("Z"));
}

TEST(Constant, NeedsOneOfSizeAndLike) {
    const auto error = [](const Json& params, const std::map<std::string, Image>& inputs) -> std::string {
        try {
            constant(params, inputs);
            return "";
        } catch (const Failure& f) {
            return f.error().what;
        }
    };
    EXPECT_THAT(error({}, {}), HasSubstr("neither 'size' nor 'like' is given"));
    EXPECT_THAT(error({{"size", {1, 1}}}, {{"like", ascii({"."})}}), HasSubstr("are both given"));
    EXPECT_THAT(error({{"size", {0, 5}}}, {}), HasSubstr("'size' is 0"));
    EXPECT_THAT(error({{"size", {2.5, 5}}}, {}), HasSubstr("2.5"));
}

}  // namespace
}  // namespace keyline::testing
