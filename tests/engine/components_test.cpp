// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/components.h"

#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace keyline {
namespace {

struct Bitmaps {
    BitRows pixels, seeds;
};

Bitmaps random_bitmaps(const Rect& window, unsigned seed, double density, double seed_density) {
    std::mt19937 random(seed);
    const auto chance = [&](double p) { return static_cast<double>(random() % 10000) < p * 10000; };
    Bitmaps out{BitRows(window), BitRows(window)};
    for (int y = window.y0; y < window.y1; ++y)
        for (int x = window.x0; x < window.x1; ++x)
            if (chance(density)) {
                out.pixels.set(y, x, x + 1);
                if (chance(seed_density)) out.seeds.set(y, x, x + 1);
            }
    return out;
}

BitRows flooded(const Bitmaps& in) {
    const Rect& window = in.pixels.rect();
    BitRows out(window);
    std::vector<std::pair<int, int>> open;
    const auto visit = [&](int x, int y) {
        if (!window.contains(x, y) || !in.pixels.test(x, y) || out.test(x, y)) return;
        out.set(y, x, x + 1);
        open.emplace_back(x, y);
    };
    for (int y = window.y0; y < window.y1; ++y)
        for (int x = window.x0; x < window.x1; ++x)
            if (in.seeds.test(x, y)) visit(x, y);
    while (!open.empty()) {
        const auto [x, y] = open.back();
        open.pop_back();
        for (int d = 0; d < 9; ++d) visit(x + d % 3 - 1, y + d / 3 - 1);
    }
    return out;
}

BitRows cut(const BitRows& from, const Rect& block) {
    BitRows out(block);
    for (int y = block.y0; y < block.y1; ++y)
        for (int x = block.x0; x < block.x1; ++x)
            if (from.test(x, y)) out.set(y, x, x + 1);
    return out;
}

// In blocks of a grid through the image's origin, as tiles are.
BitRows merged(const Bitmaps& in, int width, int height) {
    const Rect& w = in.pixels.rect();
    ComponentMerger merger(w);
    Scratch scratch;
    for (int row = floor_div(w.y0, height); row * height < w.y1; ++row)
        for (int column = floor_div(w.x0, width); column * width < w.x1; ++column) {
            const Rect block =
                intersect(w, {column * width, row * height, (column + 1) * width, (row + 1) * height});
            merger.add(find_components(cut(in.pixels, block), cut(in.seeds, block), scratch));
            scratch.reset();
        }
    return merger.finish();
}

void expect_equal(const BitRows& actual, const BitRows& expected) {
    const Rect& w = expected.rect();
    for (int y = w.y0; y < w.y1; ++y)
        for (int x = w.x0; x < w.x1; ++x) ASSERT_EQ(actual.test(x, y), expected.test(x, y)) << x << ',' << y;
}

TEST(Components, AgreeWithAFloodFillInBlocksOfAnySize) {
    const Rect windows[] = {{0, 0, 150, 40}, {-70, -33, 61, 20}, {5, 5, 6, 90}, {-1, 3, 129, 4}};
    unsigned seed = 0;
    for (const Rect& window : windows)
        for (const double density : {0.1, 0.4, 0.6, 0.97})
            for (const double seeds : {0.002, 0.05}) {
                const Bitmaps in = random_bitmaps(window, ++seed, density, seeds);
                const BitRows expected = flooded(in);
                for (const auto& [width, height] : {std::pair{1, 1}, {7, 5}, {64, 16}, {65, 3}, {500, 500}}) {
                    SCOPED_TRACE(testing::Message()
                                 << "seed " << seed << ", blocks of " << width << " × " << height);
                    expect_equal(merged(in, width, height), expected);
                }
            }
}

TEST(Components, JoinAcrossCornersOfBlocks) {
    for (const bool falling : {true, false}) {
        Bitmaps in{BitRows({0, 0, 40, 40}), BitRows({0, 0, 40, 40})};
        for (int i = 0; i < 40; ++i) in.pixels.set(i, falling ? i : 39 - i, (falling ? i : 39 - i) + 1);
        in.seeds.set(39, falling ? 39 : 0, falling ? 40 : 1);
        for (const int size : {1, 2, 8, 10}) expect_equal(merged(in, size, size), in.pixels);
    }
}

TEST(Components, ASeedDecidesForBlocksAddedLongBefore) {
    Bitmaps comb{BitRows({0, 0, 63, 30}), BitRows({0, 0, 63, 30})};
    for (int y = 0; y < 29; ++y)
        for (int x = 0; x < 63; x += 2) comb.pixels.set(y, x, x + 1);
    comb.pixels.set(29, 0, 63);
    comb.seeds.set(29, 62, 63);
    expect_equal(merged(comb, 8, 4), comb.pixels);
}

TEST(BitRows, SetsAndFindsRunsAcrossWords) {
    BitRows bits({-5, 2, 195, 4});
    EXPECT_EQ(bits.words(), 4);
    bits.set(3, 50, 190);
    EXPECT_FALSE(bits.test(49, 3));
    EXPECT_TRUE(bits.test(50, 3));
    EXPECT_TRUE(bits.test(189, 3));
    EXPECT_FALSE(bits.test(190, 3));
    EXPECT_FALSE(bits.any(3, -5, 50));
    EXPECT_TRUE(bits.any(3, -5, 51));
    EXPECT_FALSE(bits.any(3, 190, 195));
    EXPECT_FALSE(bits.any(2, -5, 195));
}

TEST(BitRows, CopiesARowFromAnyPixel) {
    std::mt19937 random(7);
    BitRows bits({0, 0, 300, 1});
    for (int x = 0; x < 300; ++x)
        if (random() % 2) bits.set(0, x, x + 1);
    for (const auto& [x0, n] : {std::pair{0, 300}, {1, 64}, {63, 65}, {64, 100}, {130, 170}, {299, 1}}) {
        std::vector<uint64_t> words(static_cast<std::size_t>((n + 63) / 64), ~uint64_t{0});
        bits.copy_row(0, x0, n, words.data());
        for (int i = 0; i < n; ++i)
            ASSERT_EQ(words[static_cast<std::size_t>(i / 64)] >> (i % 64) & 1U,
                      bits.test(x0 + i, 0) ? 1U : 0U)
                << x0 << ' ' << i;
    }
}

}  // namespace
}  // namespace keyline
