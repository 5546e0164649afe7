// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/run.h"

#include <cmath>
#include <limits>

namespace keyline::testing {
namespace {

struct Margins {
    bool inside = false;
    double m = 0, before = 0, behind = 0;  // the magnitude, and those interpolated on both sides
};

Margins margins(const Image& in, int x, int y) {
    Margins out;
    const Rect& w = in.window;
    out.inside = x > w.x0 && x < w.x1 - 1 && y > w.y0 && y < w.y1 - 1;
    const double dx = in.at("dx", x, y), dy = in.at("dy", x, y);
    const int sx = dx < 0 ? -1 : 1, sy = dy < 0 ? -1 : 1;
    const bool flat = std::abs(dx) >= std::abs(dy);
    const double longer = flat ? std::abs(dx) : std::abs(dy), shorter = flat ? std::abs(dy) : std::abs(dx);
    const double weight = longer > 0 ? shorter / longer : 0;
    const auto side = [&](int s) {
        const double axial = flat ? in.at("magnitude", x + s * sx, y) : in.at("magnitude", x, y + s * sy);
        return (1 - weight) * axial +
               weight * static_cast<double>(in.at("magnitude", x + s * sx, y + s * sy));
    };
    out.m = in.at("magnitude", x, y);
    out.before = side(-1);
    out.behind = side(1);
    return out;
}

// All three channels are kept or 0 together, as the definition says wherever it is not within rounding of a
// tie.
void expect_suppressed(const Image& in, const Image& out) {
    const Image largest = largest_within(in, 1);
    int kept = 0;
    for (int y = in.window.y0; y < in.window.y1; ++y)
        for (int x = in.window.x0; x < in.window.x1; ++x) {
            const Margins n = margins(in, x, y);
            const bool is_kept = out.at("magnitude", x, y) != 0;
            kept += is_kept ? 1 : 0;
            for (const char* c : {"dx", "dy", "magnitude"})
                ASSERT_EQ(out.at(c, x, y), is_kept ? in.at(c, x, y) : 0.0F) << c << ' ' << x << ',' << y;
            const double tolerance = 1e-5 * static_cast<double>(largest.at("Y", x, y));
            if (std::abs(n.before - n.m) <= tolerance || std::abs(n.behind - n.m) <= tolerance) continue;
            ASSERT_EQ(is_kept, n.inside && n.m > 0 && n.before <= n.m && n.behind < n.m) << x << ',' << y;
        }
    EXPECT_GT(kept, 0);
}

// A slope in x everywhere with magnitudes as drawn.
Image slope_in_x(std::initializer_list<std::string_view> rows) {
    Image image = ascii(rows, "magnitude");
    image.channels.insert(image.channels.begin(), {image.channels[0], image.channels[0]});
    image.channels[0].name = "dx";
    image.channels[1].name = "dy";
    return image.fill("dy", [](int, int) { return 0; });
}

TEST(Nms, KeepsTheRidge) {
    EXPECT_IMAGE(only(run("nms", {}, slope_in_x({"12321", "12321", "12321"})), {"magnitude"}),
                 ascii({".....", "..3..", "....."}, "magnitude"));
}

TEST(Nms, OfAPlateauKeepsTheFarSide) {
    EXPECT_IMAGE(only(run("nms", {}, slope_in_x({"......", "144421", "......"})), {"magnitude"}),
                 ascii({"......", "...4..", "......"}, "magnitude"));
}

TEST(Nms, NeverKeepsTheOutermostPixels) {
    EXPECT_IMAGE(run("nms", {}, slope_in_x({"9.9", "9.9", "9.9"})), slope_in_x({"...", "...", "..."}));
    EXPECT_IMAGE(run("nms", {}, slope_in_x({"9"})), slope_in_x({"."}));
    EXPECT_IMAGE(run("nms", {}, slope_in_x({".9."})), slope_in_x({"..."}));
}

TEST(Nms, AgreesWithTheDefinition) {
    const Image slope = run("gradient", {{"operator", "sobel"}}, noise({-9, 2, 60, 41}, {"Y"}, 1));
    expect_suppressed(slope, run("nms", {}, slope, {.tile = 11}));
}

// Any vector field, not only one that is a gradient: every octant, and zeros of both signs.
TEST(Nms, AgreesInEveryDirection) {
    Image field = noise({3, 3, 70, 50}, {"dx", "dy", "magnitude"}, 2, -1, 1);
    for (std::size_t i = 0; i < field.channels[0].samples.size(); ++i) {
        if (i % 7 == 0) field.channels[0].samples[i] = i % 2 == 0 ? 0.0F : -0.0F;
        if (i % 11 == 0) field.channels[1].samples[i] = i % 2 == 0 ? -0.0F : 0.0F;
        if (i % 13 == 0) field.channels[1].samples[i] = -field.channels[0].samples[i];
        const bool flat = field.channels[0].samples[i] == 0 && field.channels[1].samples[i] == 0;
        if (flat) field.channels[2].samples[i] = 0;
    }
    expect_suppressed(field, run("nms", {}, field));
}

TEST(Nms, AgreesOnARealPlate) {
    const Image grey = run("gaussian", {{"sigma", 1.4}}, run("ycolor", {}, plate()));
    for (const char* op : {"central", "scharr"}) {
        const Image slope = run("gradient", {{"operator", op}}, grey);
        expect_suppressed(slope, run("nms", {}, slope));
    }
}

TEST(Nms, ANanNeitherStaysNorLetsItsNeighboursStay) {
    const Image out = run("nms", {}, slope_in_x({"......", ".2x2..", "......", "..3...", "......"}));
    EXPECT_EQ(out.at("magnitude", 1, 1), 0);
    EXPECT_EQ(out.at("magnitude", 2, 1), 0);
    EXPECT_EQ(out.at("magnitude", 3, 1), 0);
    EXPECT_EQ(out.at("magnitude", 2, 3), 3);
}

TEST(Nms, NeedsAGradient) {
    EXPECT_NE(error_of("nms", {}, ascii({"."})).find("magnitude"), std::string::npos);
}

}  // namespace
}  // namespace keyline::testing
