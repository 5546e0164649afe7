// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/base/image.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace KEYLINE_API keyline {

// Percentiles of a frame, exactly, in two rounds over it: samples are counted by the upper half of their
// bits, then those that share it with a percentile by the lower half.  The percentile p of n samples is the
// one of rank ⌈p · n / 100⌉ from below (nearest rank; the first for p = 0), p to a millionth.  Samples that
// are 0 or NaN don't count.
class RankSearch {
public:
    // How often each half of the bits comes in a block: where there are fewer samples than a count for each
    // of its values would take memory, the samples' own halves.
    class Tally {
    public:
        explicit Tally(std::size_t samples);
        void add(uint32_t half) {
            bins_.empty() ? halves_.push_back(static_cast<uint16_t>(half)) : void(++bins_[half]);
        }
        void add_to(std::vector<uint64_t>& totals) const;

        static std::size_t bytes(std::size_t samples);

    private:
        std::vector<uint16_t> halves_;
        std::vector<uint32_t> bins_;
    };
    using Counts = std::vector<Tally>;  // one in the first round, one a percentile in the second

    explicit RankSearch(std::array<double, 2> percentiles) : percentiles_(percentiles) {}

    Counts count(const View& view) const;  // of a block, in the current round
    void add(const Counts& counts);
    void finish_round();

    // After both rounds; nothing where no sample counts.
    std::optional<float> value(std::size_t percentile) const { return values_[percentile]; }

    // Of the search itself, and of a block's counts.
    static std::size_t bytes() { return 2 * kBins * sizeof(uint64_t); }
    static std::size_t bytes_of_counts(const Rect& block);

private:
    static constexpr std::size_t kBins = 65536;
    using Totals = std::vector<uint64_t>;

    std::array<double, 2> percentiles_;
    int round_ = 0;
    std::vector<Totals> totals_;
    std::array<uint32_t, 2> upper_{};  // of the percentiles' bits
    std::array<uint64_t, 2> rank_{};   // from 1, among those with these upper bits
    bool any_ = false;
    std::array<std::optional<float>, 2> values_;
};

}  // namespace keyline
