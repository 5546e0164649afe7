// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/nodes/plate.h"

#include <cmath>

namespace keyline::testing {
namespace {

Image laplacian(const Image& in, bool diagonals) {
    Image out = in;
    for (Image::Channel& c : out.channels)
        out.fill(c.name, [&](int x, int y) {
            double sum = 0;
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx) {
                    if (!diagonals && dx != 0 && dy != 0) continue;
                    const int nx = std::clamp(x + dx, in.window.x0, in.window.x1 - 1);
                    const int ny = std::clamp(y + dy, in.window.y0, in.window.y1 - 1);
                    sum += double{in.at(c.name, nx, ny)} - double{in.at(c.name, x, y)};
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

TEST(Laplacian, WorksOnARender) {
    const Image in = plate("ViewLayer.Normal", {"X", "Y", "Z"});
    EXPECT_IMAGE_NEAR(run("laplacian", {{"neighbours", 8}}, in), laplacian(in, true), 1e-5);
}

TEST(Laplacian, NanReachesItsNeighboursOnly) {
    const Image out = run("laplacian", {}, ascii({".....", "..x..", "....."}));
    EXPECT_TRUE(std::isnan(out.at("Y", 2, 0)));
    EXPECT_TRUE(std::isnan(out.at("Y", 1, 1)));
    EXPECT_EQ(out.at("Y", 1, 0), 0);
    EXPECT_EQ(out.at("Y", 0, 1), 0);
}

TEST(Laplacian, HasFourNeighboursOrEight) {
    const std::string error = error_of("laplacian", {{"neighbours", 6}}, ascii({"1"}));
    EXPECT_NE(error.find("must be 4 or 8"), std::string::npos) << error;
}

}  // namespace
}  // namespace keyline::testing
