// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/nodes/plate.h"

#include <array>
#include <cmath>

namespace keyline::testing {
namespace {

struct Levels {
    double multiply, add, gamma, black, white;
};

double graded(double v, const Levels& l) {
    const double x = (v - l.black) / (l.white - l.black) * l.multiply + l.add;
    return std::copysign(std::pow(std::abs(x), 1 / l.gamma), x);
}

Image graded(const Image& in, const std::array<Levels, 3>& levels) {
    Image out = in;
    const char* rgb[] = {"R", "G", "B"};
    for (std::size_t c = 0; c < 3; ++c)
        for (float& s : out.channel(rgb[c]).samples) s = static_cast<float>(graded(double{s}, levels[c]));
    return out;
}

TEST(Grade, AgreesWithTheFormula) {
    const Image in = noise({-9, 4, 44, 27}, {"R", "G", "B", "A", "Z"}, 1, -1, 4);
    const Levels straight{1.5, -0.1, 1, 0.05, 2}, curved{0.8, 0.02, 2.2, -0.1, 0.9};
    for (const Levels& l : {straight, curved})
        EXPECT_IMAGE_NEAR(run("grade",
                              {{"multiply", l.multiply},
                               {"add", l.add},
                               {"gamma", l.gamma},
                               {"black", l.black},
                               {"white", l.white}},
                              in),
                          graded(in, {l, l, l}), 4e-5);
}

TEST(Grade, TakesANumberForEachChannel) {
    const Image in = plate("ViewLayer.Combined", {"R", "G", "B", "A"}, 16);
    EXPECT_IMAGE_NEAR(run("grade", {{"multiply", {2, 1, 0.5}}, {"gamma", {1, 1.8, 2.2}}}, in),
                      graded(in, {Levels{2, 0, 1, 0, 1}, {1, 0, 1.8, 0, 1}, {0.5, 0, 2.2, 0, 1}}), 16e-5);
}

TEST(Grade, DoesNothingByDefault) {
    const Image in = noise({0, 0, 9, 9}, {"R", "G", "B"}, 2, -3, 3);
    EXPECT_IMAGE(run("grade", {}, in), in);
}

TEST(Grade, TakesEffectWhereTheMaskIs) {
    Image in({0, 0, 3, 1}, {"R", "G", "B", "A"});
    for (Image::Channel& c : in.channels) c.samples = {1, 1, 1};
    const Image out = run("grade", {{"multiply", 3}, {"mix", 0.5}}, {{"in", in}, {"mask", ascii({".1"})}});
    EXPECT_EQ(out.channel("R").samples, (std::vector<float>{1, 2, 1}));
    EXPECT_EQ(out.channel("A").samples, (std::vector<float>{1, 1, 1}));
}

TEST(Grade, RefusesEqualBlackAndWhite) {
    const Image in({0, 0, 1, 1}, {"R", "G", "B"});
    const std::string error = error_of("grade", {{"black", 0.5}, {"white", {1, 0.5, 1}}}, in);
    EXPECT_NE(error.find("'black' and 'white' are both 0.5"), std::string::npos) << error;
}

TEST(Keymix, ShowsAWhereTheMaskIs) {
    const Image a = noise({0, 0, 6, 3}, {"R", "G", "B", "A"}, 3);
    const Image b = [] {
        Image image = noise({-2, 0, 4, 3}, {"R", "G", "B", "A", "Z"}, 4);
        image.display = {0, 0, 10, 10};
        return image;
    }();
    const Image mask = noise({1, 0, 6, 2}, {"Y"}, 5);
    Image expected({-2, 0, 6, 3}, {"R", "G", "B", "A", "Z"});
    expected.display = b.display;
    for (const char* c : {"R", "G", "B", "A"})
        expected.fill(c, [&](int x, int y) {
            const double k = double{mask.at("Y", x, y)} * 0.75;
            return double{a.at(c, x, y)} * k + double{b.at(c, x, y)} * (1 - k);
        });
    expected.fill("Z", [&](int x, int y) { return b.at("Z", x, y); });
    EXPECT_IMAGE_NEAR(run("keymix", {{"mix", 0.75}}, {{"a", a}, {"b", b}, {"mask", mask}}), expected, 1e-6);
}

// Colour without an A is opaque: dissolving to what has one must not make it see-through before.
TEST(Keymix, ColourWithoutAnAIsOpaque) {
    const Image a({0, 0, 2, 1}, {"R", "G", "B", "A"}), b({0, 0, 2, 1}, {"R", "G", "B"});
    EXPECT_EQ(run("keymix", {{"mix", 0.25}}, {{"a", a}, {"b", b}}).at("A", 1, 0), 0.75F);
}

}  // namespace
}  // namespace keyline::testing
