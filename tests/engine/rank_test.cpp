// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/rank.h"

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

float by_sorting(std::vector<float> samples, double percentile) {
    std::erase_if(samples, [](float s) { return s == 0 || std::isnan(s); });
    std::ranges::sort(samples);
    const double rank = std::ceil(percentile / 100 * static_cast<double>(samples.size()));
    return samples[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
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
    for (const auto& [low, high] : {std::pair{0.0, 100.0}, {50.0, 50.0}, {12.5, 99.9}, {0.01, 33.333}}) {
        const RankSearch search = searched(samples, {low, high});
        EXPECT_EQ(search.value(0), by_sorting(samples, low)) << low;
        EXPECT_EQ(search.value(1), by_sorting(samples, high)) << high;
    }
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
