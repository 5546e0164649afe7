// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/nodes/plate.h"

#include <cmath>
#include <optional>

namespace keyline::testing {
namespace {

Image laplacian(const Image& in, bool diagonals) {
    Image out = in;
    for (Image::Channel& c : out.channels)
        out.fill(c.name, [&](int x, int y) {
            const auto at = [&](int px, int py) {
                return in.window.contains(px, py) ? std::optional(double{in.at(c.name, px, py)})
                                                  : std::nullopt;
            };
            const double here = *at(x, y);
            double sum = 0;
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx) {
                    if (!diagonals && dx != 0 && dy != 0) continue;
                    const auto there = at(x + dx, y + dy), opposite = at(x - dx, y - dy);
                    // Beyond the edge, the line through the opposite neighbour and here goes on.
                    if (there && opposite) sum += *there - here;
                }
            return sum;
        });
    return out;
}

TEST(Laplacian, AgreesWithTheDefinitionUpToTheEdges) {
    for (const Rect& window : {Rect{-7, 3, 61, 40}, Rect{2, 2, 3, 9}, Rect{5, -1, 12, 0}, Rect{4, 4, 5, 5}})
        for (const int neighbours : {4, 8}) {
            const Image in = noise(window, {"Y", "Z"}, 1, -2, 3);
            for (const int tile : {0, 7})
                EXPECT_IMAGE_NEAR(run("laplacian", {{"neighbours", neighbours}}, in, {2, tile}),
                                  laplacian(in, neighbours == 8), 1e-5);
        }
}

TEST(Laplacian, IsZeroOnASlopeUpToTheEdges) {
    const Image slope =
        Image({-3, 5, 20, 17}, {"Z"}).fill("Z", [](int x, int y) { return 3 + 0.25 * x - 2 * y; });
    for (const int neighbours : {4, 8}) {
        const Image bent = run("laplacian", {{"neighbours", neighbours}}, slope);
        for (const float s : bent.channel("Z").samples) ASSERT_EQ(s, 0);
    }
}

TEST(Laplacian, WorksOnARender) {
    const Image in = plate("ViewLayer.Normal", {"X", "Y", "Z"});
    EXPECT_IMAGE_NEAR(run("laplacian", {{"neighbours", 8}}, in), laplacian(in, true), 1e-5);
}

TEST(Laplacian, NanReachesItsNeighboursOnly) {
    const Image out = run("laplacian", {}, ascii({".....", ".....", "..x..", ".....", "....."}));
    EXPECT_TRUE(std::isnan(out.at("Y", 2, 1)));
    EXPECT_TRUE(std::isnan(out.at("Y", 1, 2)));
    EXPECT_EQ(out.at("Y", 1, 1), 0);
    EXPECT_EQ(out.at("Y", 0, 2), 0);
}

TEST(Laplacian, HasFourNeighboursOrEight) {
    const std::string error = error_of("laplacian", {{"neighbours", 6}}, ascii({"1"}));
    EXPECT_NE(error.find("must be 4 or 8"), std::string::npos) << error;
}

}  // namespace
}  // namespace keyline::testing
