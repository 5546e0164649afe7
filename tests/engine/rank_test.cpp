// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/rank.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace keyline {
namespace {

View view(const std::vector<float>& row) {
    const Rect rect{0, 0, static_cast<int>(row.size()), 1};
    return {row.data(), rect.width(), rect, rect};
}

// In two blocks.
RankSearch searched(const std::vector<float>& samples, std::array<double, 2> percentiles) {
    RankSearch search(percentiles);
    const auto middle = samples.begin() + static_cast<std::ptrdiff_t>(samples.size() / 3);
    const std::vector<float> first(samples.begin(), middle), second(middle, samples.end());
    for (int round = 0; round < 2; ++round) {
        search.add(search.count(view(first)));
        search.add(search.count(view(second)));
        search.finish_round();
    }
    return search;
}

// A percentile as a fraction of whole numbers, as it was written: 12.5 is 125 / 10.
struct Fraction {
    int64_t over, under;
    double value() const { return static_cast<double>(over) / static_cast<double>(under); }
};

// The first of the sorted samples of which, with those before it, there are at least p of a hundred.
float by_sorting(std::vector<float> samples, const Fraction& p) {
    std::erase_if(samples, [](float s) { return s == 0 || std::isnan(s); });
    std::ranges::sort(samples);
    const auto n = static_cast<int64_t>(samples.size());
    int64_t rank = 1;
    while (rank * 100 * p.under < p.over * n) ++rank;
    return samples[static_cast<std::size_t>(rank) - 1];
}

TEST(RankSearch, FindsWhatSortingFinds) {
    std::mt19937 random(1);
    std::vector<float> samples;
    for (int i = 0; i < 5000; ++i) {
        const float s =
            std::ldexp(static_cast<float>(random() % 4096) - 2048, static_cast<int>(random() % 40) - 30);
        samples.push_back(i % 9 == 0 ? std::nanf("") : i % 7 == 0 ? -0.0F : s);
    }
    samples.push_back(std::numeric_limits<float>::infinity());
    samples.push_back(-std::numeric_limits<float>::infinity());
    samples.push_back(std::numeric_limits<float>::denorm_min());
    const std::vector<std::pair<Fraction, Fraction>> cases{
        {{0, 1}, {100, 1}}, {{50, 1}, {50, 1}}, {{125, 10}, {999, 10}}, {{1, 100}, {33333, 1000}}};
    for (const auto& [low, high] : cases) {
        const RankSearch search = searched(samples, {low.value(), high.value()});
        EXPECT_EQ(search.value(0), by_sorting(samples, low)) << low.value();
        EXPECT_EQ(search.value(1), by_sorting(samples, high)) << high.value();
    }
}

// In doubles 7 / 100 · 100 is a little more than 7.
TEST(RankSearch, CountsPercentilesExactly) {
    std::vector<float> samples;
    for (int n = 1; n <= 100; ++n) samples.push_back(static_cast<float>(n));
    for (int64_t p = 0; p <= 50; ++p) {
        const Fraction low{p, 1}, high{100 - p, 1};
        const RankSearch search = searched(samples, {low.value(), high.value()});
        EXPECT_EQ(search.value(0), by_sorting(samples, low)) << low.value();
        EXPECT_EQ(search.value(1), by_sorting(samples, high)) << high.value();
    }
    for (int n = 101; n <= 1000; ++n) samples.push_back(static_cast<float>(n));
    for (const int64_t tenths : {1, 3, 7, 29, 333, 569, 999})
        EXPECT_EQ(searched(samples, {static_cast<double>(tenths) / 10, 100}).value(0),
                  by_sorting(samples, {tenths, 10}))
            << tenths;
}

// A block that is large or small by itself.
TEST(RankSearch, CountsTakeMemoryAsTheirBlockHasSamples) {
    EXPECT_LE(RankSearch::bytes_of_counts({0, 0, 256, 64}), 256 * 64 * sizeof(float));
    EXPECT_LE(RankSearch::bytes_of_counts({0, 0, 4096, 4096}), std::size_t{512} << 10);
    std::mt19937 random(2);
    std::vector<float> samples;
    for (int i = 0; i < 400'000; ++i) samples.push_back(static_cast<float>(random() % 5000));
    EXPECT_EQ(searched(samples, {50, 99}).value(0), by_sorting(samples, {50, 1}))
        << "as many as have a table";
}

TEST(RankSearch, CountsEqualSamplesOneByOne) {
    const RankSearch search = searched({1, 2, 2, 2, 3}, {20, 80});
    EXPECT_EQ(search.value(0), 1);
    EXPECT_EQ(search.value(1), 2);
}

TEST(RankSearch, HasNothingToSayOfZerosAndNan) {
    const RankSearch search = searched({0, -0.0F, std::nanf("")}, {0, 100});
    EXPECT_EQ(search.value(0), std::nullopt);
    EXPECT_EQ(search.value(1), std::nullopt);
}

}  // namespace
}  // namespace keyline
