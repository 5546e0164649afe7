// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/crowded_strokes.h"

#include "engine/kit/piece_index.h"
#include "engine/kit/stroke_way.h"

#include <algorithm>
#include <cmath>

namespace keyline {

namespace {

constexpr double kBeside = 0.6,
                 kAlong = 0.8;       // cosines: from the one to the other a stroke counts more and more
constexpr double kEnd = 1;           // pixels from its end a stroke goes on in others rather than beside them
constexpr double kItself = 4;        // widths along a stroke: from there on it is as if it were another
constexpr std::ptrdiff_t kEven = 2;  // vertices on either side over which the change is evened out

class Crowd {
public:
    Crowd(const std::vector<Stroke>& strokes, double apart)
        : strokes_(strokes), apart_(apart), pieces_(strokes) {
        pieces_.add_all([](uint32_t, uint32_t, uint32_t) { return true; });
        for (const Stroke& s : strokes) {
            lengths_.push_back(length_of(s));
            for (const StrokeVertex& v : s.vertices) widest_ = std::max(widest_, v.width);
        }
    }

    // The share of its width that a vertex keeps.
    double share_at(uint32_t s, uint32_t i) const {
        const StrokeVertex& v = strokes_[s].vertices[i];
        double least = 1;
        pieces_.near(v.x, v.y, (widest_ + v.width) / 2 + apart_, [&](const PieceIndex::Piece& piece) {
            if (piece.stroke < s || (piece.stroke == s && piece.from < i))
                least = std::min(least, share_beside(piece, s, i));
        });
        return least;
    }

private:
    double share_beside(const PieceIndex::Piece& piece, uint32_t s, uint32_t i) const {
        const Stroke& other = pieces_.of(piece);
        const StrokeVertex &a = pieces_.from(piece), &b = pieces_.to(piece), &v = strokes_[s].vertices[i];
        const double dx = b.x - a.x, dy = b.y - a.y, length2 = dx * dx + dy * dy;
        if (!(length2 > 0)) return 1;
        const double along = ((v.x - a.x) * dx + (v.y - a.y) * dy) / length2;
        if (along < 0 || along > 1) return 1;
        const double arc = a.arc + along * std::sqrt(length2);
        if (!other.closed && (arc < kEnd || arc > other.vertices.back().arc - kEnd)) return 1;
        if (piece.stroke == s && is_here(s, arc, v)) return 1;
        const double x = v.x - a.x - along * dx, y = v.y - a.y - along * dy;
        const double free = std::sqrt(x * x + y * y) - (a.width + along * (b.width - a.width)) / 2;
        const double share = std::clamp(free / (apart_ + v.width / 2), 0.0, 1.0);
        const double cosine = std::fabs(way_cosine(strokes_[s], i, dx, dy)) / std::sqrt(length2);
        return 1 - (1 - share) * std::clamp((cosine - kBeside) / (kAlong - kBeside), 0.0, 1.0);
    }

    bool is_here(uint32_t s, double arc, const StrokeVertex& v) const {
        double apart = std::fabs(arc - v.arc);
        if (strokes_[s].closed) apart = std::min(apart, lengths_[s] - apart);
        return apart < kItself * v.width;
    }

    // Times the length of (dx, dy).
    static double way_cosine(const Stroke& s, std::size_t i, double dx, double dy) {
        const StrokeWay way = way_at(s, i);
        return way.length > 0 ? (way.x * dx + way.y * dy) / way.length : 0;
    }

    const std::vector<Stroke>& strokes_;
    std::vector<double> lengths_;
    double apart_, widest_ = 0;
    PieceIndex pieces_;
};

}  // namespace

void give_way(Strokes& strokes, double apart) {
    const std::vector<Stroke> before = strokes.strokes;
    const Crowd crowd(before, apart);
    std::vector<double> shares;
    for (uint32_t s = 0; s < before.size(); ++s) {
        shares.clear();
        for (uint32_t i = 0; i < before[s].vertices.size(); ++i) shares.push_back(crowd.share_at(s, i));
        for (std::size_t i = 0; i < shares.size(); ++i)
            strokes.strokes[s].vertices[i].width *= mean_along(shares, before[s].closed, i, kEven, false);
    }
}

}  // namespace keyline
