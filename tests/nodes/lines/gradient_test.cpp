// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/run.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace keyline::testing {
namespace {

struct Operator {
    const char* name;
    std::array<double, 3> across;  // smoothing across the derivative
    double divisor;
};

constexpr Operator kOperators[] = {{"central", {0, 1, 0}, 1},
                                   {"sobel", {1, 2, 1}, 8},
                                   {"prewitt", {1, 1, 1}, 6},
                                   {"scharr", {3, 10, 3}, 32}};

// A sample; outside the window the nearest one inside.
double edged(const Image& in, const std::string& c, int x, int y) {
    return in.at(c, std::clamp(x, in.window.x0, in.window.x1 - 1),
                 std::clamp(y, in.window.y0, in.window.y1 - 1));
}

double derivative_x(const Image& in, const std::string& c, const Operator& op, int x, int y) {
    double sum = 0;
    for (int dy = -1; dy <= 1; ++dy)
        sum += op.across[static_cast<std::size_t>(dy + 1)] *
               (edged(in, c, x + 1, y + dy) - edged(in, c, x - 1, y + dy));
    return sum / op.divisor;
}

double derivative_y(const Image& in, const std::string& c, const Operator& op, int x, int y) {
    double sum = 0;
    for (int dx = -1; dx <= 1; ++dx)
        sum += op.across[static_cast<std::size_t>(dx + 1)] *
               (edged(in, c, x + dx, y + 1) - edged(in, c, x + dx, y - 1));
    return sum / op.divisor;
}

Image gradient(const Image& in, const Operator& op) {
    Image out(in.window, {"dx", "dy", "magnitude"});
    out.display = in.display;
    const std::string& c = in.channels.front().name;
    out.fill("dx", [&](int x, int y) { return derivative_x(in, c, op, x, y); });
    out.fill("dy", [&](int x, int y) { return derivative_y(in, c, op, x, y); });
    out.fill("magnitude", [&](int x, int y) {
        return std::hypot(derivative_x(in, c, op, x, y), derivative_y(in, c, op, x, y));
    });
    return out;
}

// J = Σ over channels of [dx², dx·dy; dx·dy, dy²].
struct Tensor {
    double xx = 0, xy = 0, yy = 0;

    Tensor(const Image& in, const Operator& op, int x, int y) {
        for (const Image::Channel& c : in.channels) {
            const double dx = derivative_x(in, c.name, op, x, y), dy = derivative_y(in, c.name, op, x, y);
            xx += dx * dx, xy += dx * dy, yy += dy * dy;
        }
    }
    double larger_eigenvalue() const { return (xx + yy) / 2 + std::hypot((xx - yy) / 2, xy); }
    // How much vector·J·vector falls short of the largest that a vector of its length can have.
    double shortfall(double x, double y) const {
        return larger_eigenvalue() * (x * x + y * y) - (xx * x * x + 2 * xy * x * y + yy * y * y);
    }
};

// The magnitude is √λ, and the vector of that length lies along the eigenvector, dx > 0 or dx = 0 and dy ≥ 0.
void expect_di_zenzo(const Image& in, const Operator& op, const Image& out) {
    const Image largest = largest_within(in, 1);
    for (int y = in.window.y0; y < in.window.y1; ++y)
        for (int x = in.window.x0; x < in.window.x1; ++x) {
            const Tensor j(in, op, x, y);
            const double dx = out.at("dx", x, y), dy = out.at("dy", x, y),
                         magnitude = out.at("magnitude", x, y);
            const double tolerance = 1e-5 * static_cast<double>(largest.at("Y", x, y));
            ASSERT_NEAR(magnitude, std::sqrt(j.larger_eigenvalue()), tolerance) << op.name << x << ',' << y;
            ASSERT_NEAR(std::hypot(dx, dy), magnitude, tolerance) << op.name << x << ',' << y;
            ASSERT_LE(j.shortfall(dx, dy), 10 * tolerance * magnitude * j.larger_eigenvalue() + 1e-12)
                << op.name << x << ',' << y;
            ASSERT_TRUE(dx > 0 || (dx == 0 && dy >= 0))
                << op.name << x << ',' << y << ": " << dx << ' ' << dy;
        }
}

TEST(Gradient, IsTheSlopeOfARamp) {
    Image in({0, 0, 6, 4}, {"Y"});
    in.fill("Y", [](int x, int y) { return 2 * x + 3 * y; });
    for (const Operator& op : kOperators) {
        const Image out = run("gradient", {{"operator", op.name}}, in);
        const float scale = op.divisor == 1 ? 2.0F : 1.0F;  // the central difference is not halved
        EXPECT_FLOAT_EQ(out.at("dx", 2, 2), 2 * scale) << op.name;
        EXPECT_FLOAT_EQ(out.at("dy", 2, 2), 3 * scale) << op.name;
        EXPECT_FLOAT_EQ(out.at("magnitude", 2, 2), std::sqrt(13.0F) * scale) << op.name;
    }
}

TEST(Gradient, CentralIsOneSidedAtTheEdge) {
    Image in({0, 0, 4, 1}, {"Y"});
    in.channel("Y").samples = {1, 4, 9, 16};
    const Image out = run("gradient", {}, in);
    EXPECT_EQ(out.channel("dx").samples, (std::vector<float>{3, 8, 12, 7}));
    EXPECT_EQ(out.channel("dy").samples, (std::vector<float>{0, 0, 0, 0}));
}

TEST(Gradient, AgreesWithTheDefinition) {
    for (const Rect& window :
         {Rect{-7, 3, 61, 40}, Rect{2, 2, 3, 30}, Rect{-4, 9, 33, 10}, Rect{5, 5, 6, 6}}) {
        const Image in = noise(window, {"Y"}, 1, -1, 3);
        for (const Operator& op : kOperators)
            EXPECT_IMAGE_AGREES(run("gradient", {{"operator", op.name}}, in), gradient(in, op), in, 1);
    }
}

TEST(Gradient, AgreesOnARealPlate) {
    const Image in = only(plate("Depth"), {"Z"}), grey = only(plate(), {"G"});
    for (const Operator& op : kOperators) {
        EXPECT_IMAGE_AGREES(run("gradient", {{"operator", op.name}}, in), gradient(in, op), in, 1);
        EXPECT_IMAGE_AGREES(run("gradient", {{"operator", op.name}}, grey), gradient(grey, op), grey, 1);
    }
}

TEST(Gradient, OfSeveralChannelsIsDiZenzos) {
    const Image in = noise({-20, 4, 31, 40}, {"X", "Y", "Z"}, 2, -1, 1);
    for (const Operator& op : kOperators)
        expect_di_zenzo(in, op, run("gradient", {{"operator", op.name}}, in));
}

TEST(Gradient, OfRealNormalsIsDiZenzos) {
    const Image normals = plate("Normal");
    expect_di_zenzo(normals, kOperators[1], run("gradient", {{"operator", "sobel"}}, normals));
}

TEST(Gradient, ChannelsOfOppositeSlopeDoNotCancel) {
    Image in({0, 0, 5, 1}, {"R", "G"});
    in.fill("R", [](int x, int) { return x; }).fill("G", [](int x, int) { return -x; });
    const Image out = run("gradient", {}, in);
    EXPECT_FLOAT_EQ(out.at("magnitude", 2, 0), std::sqrt(8.0F));
    EXPECT_FLOAT_EQ(out.at("dx", 2, 0), std::sqrt(8.0F));
}

TEST(Gradient, ANanSpreadsOnlyAsFarAsItIsLookedAt) {
    const Image out = run("gradient", {}, ascii({".....", "..x..", "....."}));
    EXPECT_TRUE(std::isnan(out.at("dx", 1, 1)));
    EXPECT_TRUE(std::isnan(out.at("dy", 2, 0)));
    EXPECT_EQ(out.at("dx", 2, 0), 0);
    EXPECT_EQ(out.at("magnitude", 0, 1), 0);
}

}  // namespace
}  // namespace keyline::testing
