// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/rank.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace keyline {

namespace {

// Bits in the order of the values: negative ones turned over, the sign of the others set.
uint32_t key_of(float value) {
    const auto bits = std::bit_cast<uint32_t>(value);
    return (bits & 0x80000000U) != 0 ? ~bits : bits | 0x80000000U;
}

float value_of(uint32_t key) {
    return std::bit_cast<float>((key & 0x80000000U) != 0 ? key & 0x7FFFFFFFU : ~key);
}

bool counts(float value) { return value < 0 || value > 0; }

// ⌈percentile · n / 100⌉ in whole numbers: 7 % of 100 samples is 7, and in doubles it may be a little more.
uint64_t rank_of(double percentile, uint64_t n) {
    constexpr uint64_t kMillion = 1'000'000;
    const auto millionths = static_cast<uint64_t>(std::llround(percentile * static_cast<double>(kMillion)));
    return (millionths * n + 100 * kMillion - 1) / (100 * kMillion);
}

// The bin that holds the sample of that rank; `rank` becomes the rank inside it.
uint32_t find_bin(const std::vector<uint64_t>& totals, uint64_t& rank) {
    uint32_t bin = 0;
    while (rank > totals[bin]) rank -= totals[bin++];
    return bin;
}

}  // namespace

RankSearch::Tally::Tally(std::size_t samples) {
    if (samples * sizeof(uint16_t) > kBins * sizeof(uint32_t))
        bins_.resize(kBins, 0);
    else
        halves_.reserve(samples);  // at once: what grows takes up to twice as much
}

void RankSearch::Tally::add_to(std::vector<uint64_t>& totals) const {
    for (const uint16_t half : halves_) ++totals[half];
    for (std::size_t b = 0; b < bins_.size(); ++b) totals[b] += bins_[b];
}

std::size_t RankSearch::Tally::bytes(std::size_t samples) {
    return std::min(samples * sizeof(uint16_t), kBins * sizeof(uint32_t));
}

// In the second round the two percentiles may share their upper bits, and then every sample.
std::size_t RankSearch::bytes_of_counts(const Rect& block) {
    return 2 * Tally::bytes(static_cast<std::size_t>(block.area()));
}

RankSearch::Counts RankSearch::count(const View& view) const {
    Counts out(round_ == 0 ? 1 : percentiles_.size(), Tally(static_cast<std::size_t>(view.rect.area())));
    for (int y = view.rect.y0; y < view.rect.y1; ++y)
        for (int i = 0; i < view.rect.width(); ++i) {
            const float value = view.row(y)[i];
            if (!counts(value)) continue;
            const uint32_t key = key_of(value);
            if (round_ == 0)
                out[0].add(key >> 16);
            else
                for (std::size_t p = 0; p < out.size(); ++p)
                    if (key >> 16 == upper_[p]) out[p].add(key & 0xFFFFU);
        }
    return out;
}

void RankSearch::add(const Counts& counts) {
    totals_.resize(counts.size(), Totals(kBins, 0));
    for (std::size_t i = 0; i < counts.size(); ++i) counts[i].add_to(totals_[i]);
}

void RankSearch::finish_round() {
    if (round_++ == 0) {
        const uint64_t n =
            totals_.empty() ? 0 : std::accumulate(totals_[0].begin(), totals_[0].end(), uint64_t{0});
        any_ = n > 0;
        for (std::size_t p = 0; any_ && p < percentiles_.size(); ++p) {
            rank_[p] = std::max(rank_of(percentiles_[p], n), uint64_t{1});
            upper_[p] = find_bin(totals_[0], rank_[p]);
        }
    } else if (any_) {
        for (std::size_t p = 0; p < percentiles_.size(); ++p)
            values_[p] = value_of(upper_[p] << 16 | find_bin(totals_[p], rank_[p]));
    }
    totals_.clear();
}

}  // namespace keyline
