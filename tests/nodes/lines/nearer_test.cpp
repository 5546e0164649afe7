// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/run.h"

#include <gmock/gmock.h>

namespace keyline::testing {
namespace {

constexpr Rect kRow{0, 0, 8, 1};

// A colour that says where it is from.
Image places(const Rect& window) {
    Image out(window, {"R", "G", "B"});
    return out.fill("R", [](int x, int) { return x; }).fill("G", [](int, int y) { return y; });
}

Image nearer(const Image& depth, int radius) {
    return run("nearer", {{"radius", radius}},
               std::map<std::string, Image>{{"in", places(depth.window)}, {"depth", depth}});
}

Image depth_of(const Rect& window, std::vector<float> samples) {
    Image out(window, {"Z"});
    out.channel("Z").samples = std::move(samples);
    return out;
}

TEST(Nearer, BehindAnEdgeIsTheColourOfWhatIsInFront) {
    const Image out = nearer(depth_of(kRow, {9, 9, 9, 9, 2, 2, 2, 2}), 2);
    EXPECT_EQ(out.channel("R").samples, (std::vector<float>{0, 1, 4, 4, 4, 5, 6, 7}));
}

TEST(Nearer, NothingIsInfinitelyFar) {
    const Image out = nearer(depth_of(kRow, {0, 0, -1, 5, 1e10F, 0, 0, 0}), 2);
    EXPECT_EQ(out.channel("R").samples, (std::vector<float>{0, 3, 3, 3, 3, 3, 4, 7}));
}

TEST(Nearer, LooksAroundInBothDirections) {
    Image depth({0, 0, 5, 5}, {"Z"});
    depth.fill("Z", [](int x, int y) { return x == 3 && y == 1 ? 1 : 10; });
    const Image out = nearer(depth, 2);
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 5; ++x) {
            const bool in_reach = x >= 1 && y <= 3;
            EXPECT_EQ(out.at("R", x, y), in_reach ? 3 : x) << x << " " << y;
            EXPECT_EQ(out.at("G", x, y), in_reach ? 1 : y) << x << " " << y;
        }
}

TEST(Nearer, OfRadiusZeroIsTheImage) {
    const Image depth = noise({0, 0, 9, 7}, {"Z"}, 3, 1, 9);
    EXPECT_IMAGE(nearer(depth, 0), places({0, 0, 9, 7}));
}

}  // namespace
}  // namespace keyline::testing
