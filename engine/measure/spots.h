// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/kit/strokes.h"

#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

// Strokes cut into even pieces, so that what is counted does not depend on where their vertices happen to be.

namespace keyline {

// The middle of a piece at most half a pixel long.
struct Spot {
    double x = 0, y = 0;
    double tx = 0, ty = 0;  // the direction there, of length 1
    double length = 0;      // of the piece
    double arc = 0;         // from the stroke's first vertex
    double width = 0;
    std::size_t stroke = 0;  // which of the drawing's
    bool is_middle = false;  // of something thin: what it is drawn on lies under it, not beside it
};

inline constexpr double kSpotLength = 0.5;

// In the order of the strokes and along each; of what goes far out of the data window nothing.
std::vector<Spot> spots_of(const Strokes& drawing);

// How far `p` is from the line through a spot, and from the spot along it.
struct OffLine {
    double across = 0;  // positive on the line's left, which is outside of what owns it
    double along = 0;
};
inline OffLine off_line(const Spot& spot, double x, double y) {
    const double dx = x - spot.x, dy = y - spot.y;
    return {dx * spot.ty - dy * spot.tx, dx * spot.tx + dy * spot.ty};
}

// Whether a place lies beside the spot's piece, not before it nor behind.  Beside a bend the pieces' own
// parts leave gaps, the wider the farther out.
inline bool is_beside(const Spot& spot, const OffLine& off) {
    constexpr double kBend = 0.2, kRounding = 0.01;
    return std::fabs(off.along) <= spot.length / 2 + kBend * std::fabs(off.across) + kRounding;
}

inline double cosine(const Spot& a, const Spot& b) { return a.tx * b.tx + a.ty * b.ty; }

class SpotIndex {
public:
    explicit SpotIndex(const std::vector<Spot>& spots);

    // visit(index) of all spots that may be within `reach` of a place, in an order that only depends on them.
    template <class Visit>
    void near(double x, double y, double reach, const Visit& visit) const {
        for (int64_t row = cell_of(y - reach); row <= cell_of(y + reach); ++row)
            for (int64_t column = cell_of(x - reach); column <= cell_of(x + reach); ++column)
                if (const auto it = cells_.find(key(column, row)); it != cells_.end())
                    for (const std::size_t i : it->second) visit(i);
    }

private:
    static constexpr double kCell = 2;  // pixels
    static int64_t cell_of(double v) { return static_cast<int64_t>(std::floor(v / kCell)); }
    static uint64_t key(int64_t column, int64_t row) {
        return uint64_t{static_cast<uint32_t>(row)} << 32 | static_cast<uint32_t>(column);
    }
    std::unordered_map<uint64_t, std::vector<std::size_t>> cells_;
};

}  // namespace keyline
