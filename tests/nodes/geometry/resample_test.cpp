// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/nodes/plate.h"

#include <cmath>
#include <functional>
#include <gmock/gmock.h>

// reformat and transform, against the convolution written out.

namespace keyline::testing {
namespace {

constexpr double kPi = 3.14159265358979323846;

double sinc(double x) { return x == 0 ? 1 : std::sin(kPi * x) / (kPi * x); }

struct Kernel {
    double radius;
    std::function<double(double)> weight;
};

// Catmull and Rom's cubic as Keys wrote it, a = -1/2.
double keys(double x) {
    const double d = std::abs(x);
    return d < 1 ? 1.5 * d * d * d - 2.5 * d * d + 1 : d < 2 ? -0.5 * d * d * d + 2.5 * d * d - 4 * d + 2 : 0;
}

double mitchell(double x) {
    const double d = std::abs(x);
    return d < 1   ? (21 * d * d * d - 36 * d * d + 16) / 18
           : d < 2 ? (-7 * d * d * d + 36 * d * d - 60 * d + 32) / 18
                   : 0;
}

const std::map<std::string, Kernel> kKernels{
    {"box", {0.5, [](double x) { return x >= -0.5 && x < 0.5 ? 1.0 : 0.0; }}},
    {"triangle", {1, [](double x) { return std::max(0.0, 1 - std::abs(x)); }}},
    {"cubic", {2, keys}},
    {"mitchell", {2, mitchell}},
    {"lanczos", {3, [](double x) { return std::abs(x) < 3 ? sinc(x) * sinc(x / 3) : 0; }}}};

// The image around a point, through a kernel stretched in x and y; `renormalise` leaves out what lies
// outside.
double sampled(const Image& in, const std::string& channel, const Kernel& kernel, double px, double py,
               double fx, double fy, bool renormalise) {
    double sum = 0, all = 0;
    const auto reach = [&](double p, double f) {
        return std::pair(static_cast<int>(std::floor(p - kernel.radius * f)) - 1,
                         static_cast<int>(std::ceil(p + kernel.radius * f)) + 1);
    };
    const auto [x0, x1] = reach(px, fx);
    const auto [y0, y1] = reach(py, fy);
    for (int y = y0; y <= y1; ++y)
        for (int x = x0; x <= x1; ++x) {
            if (renormalise && !in.window.contains(x, y)) continue;
            const double w = kernel.weight((x + 0.5 - px) / fx) * kernel.weight((y + 0.5 - py) / fy);
            sum += w * double{in.at(channel, x, y)};
            all += w;
        }
    return sum / all;
}

TEST(Reformat, AgreesWithTheConvolution) {
    const Image in = noise({0, 0, 40, 24}, {"R", "Z"}, 1);
    for (const auto& [name, kernel] : kKernels)
        for (const auto& [w, h] : {std::pair(61, 37), std::pair(17, 11), std::pair(80, 7)}) {
            SCOPED_TRACE(name);
            const Image out =
                run("reformat", {{"size", {w, h}}, {"resize", "distort"}, {"filter", name}}, in, {2, 7});
            const double sx = w / 40.0, sy = h / 24.0;
            Image expected({0, 0, w, h}, {"R", "Z"});
            for (const char* c : {"R", "Z"})
                expected.fill(c, [&, &used = kernel](int x, int y) {
                    return sampled(in, c, used, (x + 0.5) / sx, (y + 0.5) / sy, std::max(1.0, 1 / sx),
                                   std::max(1.0, 1 / sy), true);
                });
            EXPECT_IMAGE_NEAR(out, expected, 1e-5);
        }
}

TEST(Reformat, LaysTheImageOnTheFormat) {
    const Image in = noise({0, 0, 40, 20}, {"Y"}, 2);
    const auto window = [&](const char* resize) {
        return run("reformat", {{"size", {20, 20}}, {"resize", resize}}, in).window;
    };
    EXPECT_EQ(window("fit"), (Rect{0, 5, 20, 15}));
    EXPECT_EQ(window("width"), (Rect{0, 5, 20, 15}));
    EXPECT_EQ(window("fill"), (Rect{-10, 0, 30, 20}));
    EXPECT_EQ(window("height"), (Rect{-10, 0, 30, 20}));
    EXPECT_EQ(window("distort"), (Rect{0, 0, 20, 20}));
    EXPECT_EQ(window("none"), (Rect{-10, 0, 30, 20}));
}

TEST(Reformat, ToItsOwnFormatIsTheImage) {
    const Image in = plate("ViewLayer.Combined", {"R", "G", "B", "A"}, 16);
    const Json size{in.display.width(), in.display.height()};
    for (const char* filter : {"nearest", "box", "triangle", "cubic", "lanczos"})
        EXPECT_IMAGE(run("reformat", {{"size", size}, {"filter", filter}}, in), in);
}

// It grows by what the filter reaches.
TEST(Reformat, KeepsAnOffsetDataWindow) {
    Image in({10, 4, 30, 16}, {"Y"});
    in.display = {0, 0, 40, 20};
    in.fill("Y", [](int, int) { return 0.75; });
    const Image out = run("reformat", {{"size", {60, 30}}}, in);
    EXPECT_TRUE(out.window.contains(Rect{15, 6, 45, 24}));
    EXPECT_TRUE((Rect{9, 0, 51, 30}.contains(out.window)));
    EXPECT_EQ(out.display, (Rect{0, 0, 60, 30}));
    EXPECT_EQ(out.at("Y", 30, 15), 0.75F);
    EXPECT_EQ(std::as_const(out).at("Y", 5, 15), 0);
}

TEST(Transform, AgreesWithTheConvolution) {
    const Image in = noise({2, -3, 32, 19}, {"Y"}, 3);
    const double angle = 25 * kPi / 180, s = std::sin(angle), c = std::cos(angle);
    for (const auto& [name, kernel] : kKernels)
        for (const auto& [sx, sy] : {std::pair(1.0, 1.0), std::pair(1.7, 0.6)}) {
            SCOPED_TRACE(name);
            const Image out = run("transform",
                                  {{"translate", {3.25, -1.5}},
                                   {"rotate", 25},
                                   {"scale", {sx, sy}},
                                   {"center", {10, 8}},
                                   {"filter", name}},
                                  in, {2, 7});
            const double fx = std::max(1.0, 1 / sx), fy = std::max(1.0, 1 / sy);
            Image expected = out;
            expected.fill("Y", [&, &used = kernel, wide = sx, high = sy](int x, int y) {
                const double qx = x + 0.5 - 13.25, qy = y + 0.5 - 6.5;
                return sampled(in, "Y", used, (c * qx - s * qy) / wide + 10, (s * qx + c * qy) / high + 8, fx,
                               fy, false);
            });
            EXPECT_IMAGE_NEAR(out, expected, 1e-5);
            // Nothing of the image lies beyond the data window.
            for (const int y : {out.window.y0 - 1, out.window.y1})
                for (int x = out.window.x0; x < out.window.x1; ++x) {
                    const double qx = x + 0.5 - 13.25, qy = y + 0.5 - 6.5;
                    ASSERT_EQ(sampled(in, "Y", kernel, (c * qx - s * qy) / sx + 10,
                                      (s * qx + c * qy) / sy + 8, fx, fy, false),
                              0);
                }
        }
}

TEST(Transform, ByWholePixelsMovesThem) {
    const Image in = noise({0, 0, 20, 10}, {"Y"}, 4);
    for (const char* filter : {"nearest", "box", "triangle", "cubic", "lanczos"}) {
        const Image out = run("transform", {{"translate", {7, -3}}, {"filter", filter}}, in);
        for (int y = 0; y < 10; ++y)
            for (int x = 0; x < 20; ++x) ASSERT_EQ(out.at("Y", x + 7, y - 3), in.at("Y", x, y)) << filter;
    }
}

TEST(Transform, QuarterTurnsAreExact) {
    const Image in = noise({0, 0, 8, 8}, {"Y"}, 5);
    const Image out = run("transform", {{"rotate", 90}}, in);  // counter-clockwise: right becomes top
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) ASSERT_EQ(out.at("Y", x, y), in.at("Y", 7 - y, x)) << x << ',' << y;
}

TEST(Transform, DoesNothingByDefault) {
    const Image in = noise({3, 3, 9, 9}, {"Y"}, 6);
    EXPECT_IMAGE(run("transform", {}, in), in);
}

TEST(Transform, ReadsOnlyWhatItShows) {
    const Image in = plate("ViewLayer.Combined", {"R"}, 16);
    const Json params{{"rotate", -33}, {"scale", 0.4}, {"filter", "mitchell"}};
    EXPECT_IMAGE(run("transform", params, in, {2, 64}), run("transform", params, in, {1, 2000}));
}

TEST(Reformat, KeepsAConstantToTheLastBit) {
    for (const char* filter : {"nearest", "box", "triangle", "cubic", "mitchell", "lanczos"})
        for (const auto& [width, height] : {std::pair{64, 40}, std::pair{13, 57}, std::pair{3, 2}})
            for (const float value : {0.3F, 0.1F, 7e-20F, -123.4F}) {
                const Image in = noise({0, 0, 41, 30}, {"Y"}, 1, value, value);
                const Image out = run(
                    "reformat", {{"size", {width, height}}, {"resize", "distort"}, {"filter", filter}}, in);
                EXPECT_THAT(out.channel("Y").samples, ::testing::Each(value)) << filter;
            }
}

TEST(Transform, KeepsAConstantToTheLastBitInside) {
    for (const char* filter : {"box", "triangle", "cubic", "mitchell", "lanczos"}) {
        const Image in = noise({0, 0, 60, 60}, {"Y"}, 1, 0.3F, 0.3F);
        const Image out = run("transform", {{"rotate", 17}, {"scale", {1.3, 0.8}}, {"filter", filter}}, in);
        for (int y = 25; y < 35; ++y)
            for (int x = 25; x < 35; ++x) EXPECT_EQ(out.at("Y", x, y), 0.3F) << filter;
    }
}

// Beyond the data window and inside the display window there is black to be averaged with.
TEST(Reformat, AnObjectInACutDataWindowGrowsNoFatter) {
    Image cut = noise({10, 10, 21, 21}, {"Y"}, 1, 1, 1);
    cut.display = {0, 0, 32, 32};
    const Image out = run("reformat", {{"size", {20, 20}}}, cut);
    double sum = 0;
    for (const float v : out.channel("Y").samples) sum += double{v};
    EXPECT_NEAR(sum, 11 * 11 * 0.625 * 0.625, 0.3);
    EXPECT_TRUE((Rect{0, 0, 20, 20}).contains(out.window));
}

float pixel_aspect_of(const Image& image) {
    return std::get<std::vector<float>>(image.metadata.find("pixelAspectRatio")->value).front();
}

TEST(Reformat, DistortedPixelsTakeTheAspectThatKeepsThePicturesShape) {
    Image squeezed = noise({0, 0, 32, 32}, {"Y"}, 1);
    squeezed.metadata.set({"pixelAspectRatio", "float", std::vector<float>{2}});
    const auto to = [&](int width, int height, const char* resize) {
        return pixel_aspect_of(run("reformat", {{"size", {width, height}}, {"resize", resize}}, squeezed));
    };
    EXPECT_EQ(to(64, 32, "distort"), 1);
    EXPECT_EQ(to(32, 32, "distort"), 2);
    EXPECT_EQ(to(32, 64, "distort"), 4);
    EXPECT_EQ(to(64, 32, "fit"), 2);
}

TEST(Transform, AStretchChangesPixelsThatAreNotSquare) {
    Image squeezed = noise({0, 0, 16, 16}, {"Y"}, 1);
    const auto stretched = [&](float aspect, double rotate) {
        squeezed.metadata.set({"pixelAspectRatio", "float", std::vector<float>{aspect}});
        return pixel_aspect_of(run("transform", {{"scale", {2, 1}}, {"rotate", rotate}}, squeezed));
    };
    EXPECT_EQ(stretched(2, 0), 1);
    EXPECT_EQ(stretched(2, 180), 1);
    EXPECT_EQ(stretched(2, 45), 2);
    EXPECT_EQ(stretched(1, 0), 1);
}

}  // namespace
}  // namespace keyline::testing
