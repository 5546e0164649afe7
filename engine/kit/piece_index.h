// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/kit/strokes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

// The pieces of strokes between their vertices, by place.

namespace keyline {

class PieceIndex {
public:
    struct Piece {
        uint32_t stroke = 0, from = 0, to = 0;  // vertices
    };

    // The strokes must stay where they are.
    explicit PieceIndex(const std::vector<Stroke>& strokes) : strokes_(strokes) {}

    // All pieces of the strokes for which keep(stroke, from, to) holds.
    template <class Keep>
    void add_all(const Keep& keep) {
        for (uint32_t s = 0; s < strokes_.size(); ++s) {
            const auto n = static_cast<uint32_t>(strokes_[s].vertices.size());
            for (uint32_t i = 0; i + (strokes_[s].closed ? 0 : 1) < n; ++i)
                if (const uint32_t k = (i + 1) % n; keep(s, i, k)) add({s, i, k});
        }
    }

    const StrokeVertex& from(const Piece& p) const { return strokes_[p.stroke].vertices[p.from]; }
    const StrokeVertex& to(const Piece& p) const { return strokes_[p.stroke].vertices[p.to]; }
    const Stroke& of(const Piece& p) const { return strokes_[p.stroke]; }

    // visit(piece) of all that may be within `reach` of a place, in an order that only depends on them.
    template <class Visit>
    void near(double x, double y, double reach, const Visit& visit) const {
        const double far = reach + longest_, cells = 2 * far / kCell + 1;
        if (cells * cells > static_cast<double>(short_.size())) {
            for (const Piece& piece : short_) visit(piece);
        } else {
            for (int64_t row = cell_of(y - far); row <= cell_of(y + far); ++row)
                for (int64_t column = cell_of(x - far); column <= cell_of(x + far); ++column)
                    if (const auto it = cells_.find(key(column, row)); it != cells_.end())
                        for (const std::size_t i : it->second) visit(short_[i]);
        }
        for (const Piece& piece : long_) visit(piece);
    }

private:
    static constexpr double kCell = 4, kLong = 16;  // pixels

    static int64_t cell_of(double v) { return static_cast<int64_t>(std::floor(v / kCell)); }
    static uint64_t key(int64_t column, int64_t row) {
        return uint64_t{static_cast<uint32_t>(row)} << 32 | static_cast<uint32_t>(column);
    }

    void add(const Piece& piece) {
        const StrokeVertex &a = from(piece), &b = to(piece);
        const double length = std::fabs(b.x - a.x) + std::fabs(b.y - a.y);
        if (length > kLong) return long_.push_back(piece);
        longest_ = std::max(longest_, length);
        cells_[key(cell_of(a.x), cell_of(a.y))].push_back(short_.size());
        short_.push_back(piece);
    }

    const std::vector<Stroke>& strokes_;
    std::vector<Piece> short_, long_;  // long: what a search of the cells around can't reach
    std::unordered_map<uint64_t, std::vector<std::size_t>> cells_;  // the short ones by where they begin
    double longest_ = 0;                                            // of those
};

}  // namespace keyline
