// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/kit/by_place.h"
#include "engine/kit/strokes.h"

#include <cstdint>
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

    // visit(piece) of all that may be within `reach` of a place, some more than once, in an order that only
    // depends on them.
    template <class Visit>
    void near(double x, double y, double reach, const Visit& visit) const {
        pieces_.any_near(x, y, reach, [&](const Piece& piece) { return visit(piece), false; });
    }

private:
    void add(const Piece& piece) {
        const StrokeVertex &a = from(piece), &b = to(piece);
        pieces_.add(a.x, a.y, b.x - a.x, b.y - a.y, piece);
    }

    const std::vector<Stroke>& strokes_;
    ByPlace<Piece> pieces_;
};

}  // namespace keyline
