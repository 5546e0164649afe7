// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/run.h"

#include <algorithm>

// Lines from depth, as graphs/saito_takahashi.json makes them: 1/Z is linear on the screen on every plane of
// a perspective view, so that its second derivative sees creases and outlines, and no plane however grazing.

namespace keyline::testing {
namespace {

struct Plane {
    double at, dx, dy;  // 1/Z, and its slopes

    double depth(int x, int y) const { return 1 / (at + dx * x + dy * y); }
};

Image internal_edges(const Image& depth) {
    const Json nodes{{"near", {{"type", "math"}, {"in", "depth"}, {"op", "reciprocal"}}},
                     {"bend", {{"type", "laplacian"}, {"in", "near"}, {"neighbours", 8}}},
                     {"bent", {{"type", "math"}, {"in", "bend"}, {"op", "abs"}}},
                     {"crease", {{"type", "math"}, {"in", "bent"}, {"op", "divide"}, {"b", "near"}}},
                     {"edges", {{"type", "threshold"}, {"in", "crease"}, {"low", 0.002}}}};
    return run_graph(nodes, "edges", std::map<std::string, Image>{{"depth", depth}});
}

Image view(const std::function<double(int, int)>& depth) {
    return Image({0, 0, 160, 90}, {"Z"}).fill("Z", depth);
}

TEST(DepthLines, NoneOnPlanesHoweverGrazing) {
    // From a wall that faces the camera to a floor whose far end is 160 times as far as its near one.
    for (const Plane& plane : {Plane{0.1, 0, 0}, Plane{1, -0.003, 0.002}, Plane{0.01, 0, 0.001},
                               Plane{2, -0.0124, 0}, Plane{0.001, 0.0005, 0.0008}}) {
        const Image edges = internal_edges(view([&](int x, int y) { return plane.depth(x, y); }));
        EXPECT_EQ(std::ranges::count(edges.channel("Z").samples, 0.0F), 160 * 90)
            << plane.dx << ' ' << plane.dy;
    }
}

TEST(DepthLines, WhereTwoPlanesMeet) {
    const Plane floor{0.02, 0, 0.004}, wall{0.3, 0.001, -0.002};
    const auto nearer = [&](int x, int y) { return std::min(floor.depth(x, y), wall.depth(x, y)); };
    const auto on_floor = [&](int x, int y) { return floor.depth(x, y) < wall.depth(x, y); };
    const Image edges = internal_edges(view(nearer));
    for (int y = 1; y < 89; ++y)
        for (int x = 1; x < 159; ++x) {
            bool both = false;
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx) both |= on_floor(x + dx, y + dy) != on_floor(x, y);
            ASSERT_TRUE(both || edges.at("Z", x, y) == 0) << x << ' ' << y;
            ASSERT_TRUE(on_floor(x, y - 1) == on_floor(x, y) || edges.at("Z", x, y) == 1) << x << ' ' << y;
        }
}

}  // namespace
}  // namespace keyline::testing
