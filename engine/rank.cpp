// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/rank.h"

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

// The bin that holds the sample of that rank; `rank` becomes the rank inside it.
uint32_t find_bin(const std::vector<uint64_t>& totals, uint64_t& rank) {
    uint32_t bin = 0;
    while (rank > totals[bin]) rank -= totals[bin++];
    return bin;
}

}  // namespace

RankSearch::Counts RankSearch::count(const View& view) const {
    Counts out(round_ == 0 ? 1 : percentiles_.size(), Bins(kBins, 0));
    for (int y = view.rect.y0; y < view.rect.y1; ++y)
        for (int i = 0; i < view.rect.width(); ++i) {
            const float value = view.row(y)[i];
            if (!counts(value)) continue;
            const uint32_t key = key_of(value);
            if (round_ == 0)
                ++out[0][key >> 16];
            else
                for (std::size_t p = 0; p < out.size(); ++p)
                    if (key >> 16 == upper_[p]) ++out[p][key & 0xFFFFU];
        }
    return out;
}

void RankSearch::add(const Counts& counts) {
    totals_.resize(counts.size(), Totals(kBins, 0));
    for (std::size_t i = 0; i < counts.size(); ++i)
        for (std::size_t b = 0; b < kBins; ++b) totals_[i][b] += counts[i][b];
}

void RankSearch::finish_round() {
    if (round_++ == 0) {
        const uint64_t n =
            totals_.empty() ? 0 : std::accumulate(totals_[0].begin(), totals_[0].end(), uint64_t{0});
        any_ = n > 0;
        for (std::size_t p = 0; any_ && p < percentiles_.size(); ++p) {
            const double rank = std::ceil(percentiles_[p] / 100 * static_cast<double>(n));
            rank_[p] = std::clamp<uint64_t>(static_cast<uint64_t>(rank), 1, n);
            upper_[p] = find_bin(totals_[0], rank_[p]);
        }
    } else if (any_) {
        for (std::size_t p = 0; p < percentiles_.size(); ++p)
            values_[p] = value_of(upper_[p] << 16 | find_bin(totals_[p], rank_[p]));
    }
    totals_.clear();
}

}  // namespace keyline
