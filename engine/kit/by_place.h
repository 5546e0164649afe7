// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

// Pieces of lines by where they begin.

namespace KEYLINE_API keyline {

template <class Piece>
class ByPlace {
public:
    // `length`: how far it reaches from (x, y) at most, in pixels.
    void add(double x, double y, double length, Piece piece) {
        if (!(length <= kLong)) return long_.push_back(std::move(piece));
        longest_ = std::max(longest_, length);
        cells_[key(cell_of(x), cell_of(y))].push_back(short_.size());
        short_.push_back(std::move(piece));
    }

    std::size_t size() const { return short_.size() + long_.size(); }

    // visit(piece) of all that may be within `reach` of a place, until it returns true; whether it did.
    // Others are visited too: it has to look.
    template <class Visit>
    bool any_near(double x, double y, double reach, const Visit& visit) const {
        const double far = reach + longest_, cells = 2 * far / kCell + 1;
        if (!(cells * cells <= static_cast<double>(short_.size())))
            return std::ranges::any_of(short_, visit) || std::ranges::any_of(long_, visit);
        for (int64_t row = cell_of(y - far); row <= cell_of(y + far); ++row)
            for (int64_t column = cell_of(x - far); column <= cell_of(x + far); ++column)
                if (const auto it = cells_.find(key(column, row)); it != cells_.end())
                    for (const std::size_t i : it->second)
                        if (visit(short_[i])) return true;
        return std::ranges::any_of(long_, visit);
    }

    friend bool operator==(const ByPlace&, const ByPlace&) = default;

private:
    static constexpr double kCell = 4,
                            kLong = 16;  // pixels; what is longer no search of the cells around can reach

    static int64_t cell_of(double v) { return static_cast<int64_t>(std::floor(v / kCell)); }
    static uint64_t key(int64_t column, int64_t row) {
        return uint64_t{static_cast<uint32_t>(row)} << 32 | static_cast<uint32_t>(column);
    }

    std::vector<Piece> short_, long_;
    std::unordered_map<uint64_t, std::vector<std::size_t>> cells_;  // of the short ones
    double longest_ = 0;                                            // of those
};

}  // namespace keyline
