// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/run.h"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <limits>

namespace keyline::testing {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// From every strong pixel over its eight neighbours, as far as pixels are weak.
Image flooded(const Image& in, const std::string& channel, float low, float high) {
    Image out(in.window, {"edge"});
    out.display = in.display;
    std::vector<std::pair<int, int>> open;
    const auto visit = [&](int x, int y) {
        if (!in.window.contains(x, y) || !(in.at(channel, x, y) > low) || out.at("edge", x, y) == 1) return;
        out.at("edge", x, y) = 1;
        open.emplace_back(x, y);
    };
    for (int y = in.window.y0; y < in.window.y1; ++y)
        for (int x = in.window.x0; x < in.window.x1; ++x) {
            if (in.at(channel, x, y) >= high) visit(x, y);
            while (!open.empty()) {
                const auto [px, py] = open.back();
                open.pop_back();
                for (int dy = -1; dy <= 1; ++dy)
                    for (int dx = -1; dx <= 1; ++dx) visit(px + dx, py + dy);
            }
        }
    return out;
}

// A spiral of 1s one pixel wide, two apart: one component through every tile, many times.
Image spiral(int size) {
    Image image({0, 0, size, size}, {"Y"});
    int x = 0, y = 0, dx = 1, dy = 0;
    const auto blocked = [&](int steps) {
        const int nx = x + steps * dx, ny = y + steps * dy;
        return !image.window.contains(nx, ny) || image.at("Y", nx, ny) != 0;
    };
    image.at("Y", x, y) = 1;
    for (int turns = 0; turns < 2;) {
        const int next_x = x + 2 * dx, next_y = y + 2 * dy;
        if (blocked(1) || (image.window.contains(next_x, next_y) && image.at("Y", next_x, next_y) != 0)) {
            const int old = dx;
            dx = -dy, dy = old;
            ++turns;
            continue;
        }
        x += dx, y += dy, turns = 0;
        image.at("Y", x, y) = 1;
    }
    return image;
}

Json thresholds(double low, double high) { return {{"low", low}, {"high", high}}; }

TEST(Hysteresis, KeepsWeakPixelsThatTouchAStrongOne) {
    EXPECT_IMAGE(run("hysteresis", thresholds(1, 3),
                     ascii({"..2....", ".2...22", "3......",  //
                            "....1..", "22..1.3"})),
                 ascii({"..1....", ".1.....", "1......",  //
                        ".......", "......1"},
                       "edge"));
}

TEST(Hysteresis, LowIsExclusiveAndHighInclusive) {
    EXPECT_IMAGE(run("hysteresis", thresholds(2, 5), ascii({"25352"})), ascii({".111."}, "edge"));
    EXPECT_IMAGE(run("hysteresis", thresholds(2, 2), ascii({"123"})), ascii({"..1"}, "edge"));
    EXPECT_IMAGE(run("hysteresis", thresholds(0, 0), ascii({".1."})), ascii({".1."}, "edge"));
}

TEST(Hysteresis, HighIsThreeTimesLowWhenAbsent) {
    EXPECT_IMAGE(run("hysteresis", {{"low", 2}}, ascii({"35.36.3"})), ascii({"...11.."}, "edge"));
}

TEST(Hysteresis, FollowsASpiralThroughEveryTile) {
    Image in = spiral(151);
    Image whole(in.window, {"edge"});
    whole.channels[0].samples = in.channels[0].samples;
    in.at("Y", 0, 0) = 5;  // the one strong pixel is at the outer end
    for (const int tile : {1, 7, 32, 100, 151})
        EXPECT_TRUE(same(run("hysteresis", thresholds(0.5, 5), in, {.tile = tile}), whole)) << tile;
}

TEST(Hysteresis, AgreesWithAFloodFillOnNoise) {
    for (unsigned seed = 0; seed < 12; ++seed) {
        // About the density at which components just begin to span the frame.
        const Image in = moved(noise({0, 0, 90, 70}, {"Y"}, seed), static_cast<int>(seed) * 31 - 200, -33);
        const Image out =
            run("hysteresis", thresholds(0.6, 0.99), in, {.tile = 3 + 5 * static_cast<int>(seed)});
        EXPECT_IMAGE(out, flooded(in, "Y", 0.6F, 0.99F)) << seed;
    }
}

TEST(Hysteresis, TakesTheMagnitudeOfARealPlate) {
    const Image grey = run("ycolor", {}, plate());
    const Image slope = run("gradient", {{"operator", "sobel"}}, grey);
    EXPECT_TRUE(
        same(run("hysteresis", thresholds(0.01, 0.1), slope), flooded(slope, "magnitude", 0.01F, 0.1F)));
}

TEST(Hysteresis, UnitsOfTheLargestValue) {
    Image in = noise({-5, 2, 70, 60}, {"Y"}, 3);
    in.at("Y", 30, 30) = 8;
    in.at("Y", 31, 31) = kNan;
    const Image out = run("hysteresis", {{"low", 0.05}, {"high", 0.11}, {"units", "max"}}, in, {.tile = 16});
    EXPECT_TRUE(same(out, flooded(in, "Y", 0.4F, static_cast<float>(0.11 * 8))));
}

TEST(Hysteresis, UnitsOfNearestRankAmongSamplesThatAreNotZero) {
    Image in = noise({3, -40, 80, 21}, {"Y"}, 4, -1, 1);
    std::vector<float> sorted;
    for (std::size_t i = 0; i < in.channel("Y").samples.size(); ++i) {
        float& s = in.channel("Y").samples[i];
        if (i % 5 == 0) s = i % 2 == 0 ? 0.0F : -0.0F;
        if (i % 97 == 0) s = kNan;
        if (s != 0 && !std::isnan(s)) sorted.push_back(s);
    }
    std::ranges::sort(sorted);
    // The least value that counts as equal.
    const auto percentile = [&](double p) {
        const double rank = std::ceil(p / 100 * static_cast<double>(sorted.size()));
        const float value = sorted[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
        return value - std::fabs(value) * 0x1p-18F;
    };
    for (const auto& [low, high] : {std::pair{70.0, 98.5}, {0.0, 100.0}, {33.3, 33.3}, {50.0, 99.99}}) {
        const Image out =
            run("hysteresis", {{"low", low}, {"high", high}, {"units", "percentile"}}, in, {.tile = 19});
        EXPECT_TRUE(same(out, flooded(in, "Y", std::nextafter(percentile(low), -2.0F), percentile(high))))
            << low << ' ' << high;
    }
}

TEST(Hysteresis, WithoutASampleThereIsNoEdge) {
    for (const char* units : {"max", "percentile"})
        for (const Image& in : {ascii({"...", "..."}), ascii({"x.x"})})
            EXPECT_IMAGE(run("hysteresis", {{"low", 0}, {"high", 0}, {"units", units}}, in),
                         Image(in.window, {"edge"}));
}

TEST(Hysteresis, ANanIsNoEdgeAndJoinsNothing) {
    EXPECT_IMAGE(run("hysteresis", thresholds(0.5, 3), ascii({"1x3x1"})), ascii({"..1.."}, "edge"));
}

TEST(Hysteresis, NegativeSamplesAreBelowEveryThreshold) {
    Image in = ascii({".1.3."});
    in.at("Y", 2, 0) = -5;
    EXPECT_IMAGE(run("hysteresis", thresholds(0, 2), in), ascii({"...1."}, "edge"));
}

TEST(Hysteresis, RefusesThresholdsThatMakeNoSense) {
    const Image in = ascii({"."});
    EXPECT_THAT(error_of("hysteresis", thresholds(0.9, 0.4), in),
                ::testing::HasSubstr("'low' is 0.9; it must not be above 'high', which is 0.4"));
    EXPECT_THAT(error_of("hysteresis", {{"low", -1}}, in),
                ::testing::HasSubstr("'low' is -1; it must be at least 0"));
    EXPECT_THAT(error_of("hysteresis", {{"low", 10}, {"units", "percentile"}}, in),
                ::testing::HasSubstr("'high' is missing"));
    EXPECT_THAT(error_of("hysteresis", {{"low", 10}, {"high", 101}, {"units", "percentile"}}, in),
                ::testing::HasSubstr("at most 100"));
    EXPECT_THAT(error_of("hysteresis", {}, in), ::testing::HasSubstr("parameter 'low' is missing"));
}

}  // namespace
}  // namespace keyline::testing
