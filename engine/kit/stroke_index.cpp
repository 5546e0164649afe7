// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/stroke_index.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace keyline {

namespace {

constexpr double kSameWay = 0.8;  // cosine
constexpr double kBend = 0.5;  // what is beyond a piece's end for each pixel aside, in bends up to 53 degrees

}  // namespace

void StrokeIndex::add(const Stroke& stroke) {
    const std::vector<StrokeVertex>& v = stroke.vertices;
    for (std::size_t i = 0; i + (stroke.closed ? 0 : 1) < v.size(); ++i) {
        const StrokeVertex& next = v[(i + 1) % v.size()];
        const Piece piece{v[i].x,
                          v[i].y,
                          next.x - v[i].x,
                          next.y - v[i].y,
                          stroke.kind,
                          !stroke.closed && i == 0,
                          !stroke.closed && i + 2 == v.size(),
                          strokes_};
        pieces_.add(piece.x, piece.y, piece.dx, piece.dy, piece);
    }
    ++strokes_;
}

bool StrokeIndex::has(const Along& along) const {
    return pieces_.any_near(along.x, along.y, within_,
                            [&](const Piece& piece) { return is_beside(piece, along); });
}

double StrokeIndex::ahead(const Along& from, double reach, int except) const {
    double least = std::numeric_limits<double>::infinity();
    pieces_.any_near(from.x, from.y, reach, [&](const Piece& piece) {
        const double turn = from.tx * piece.dy - from.ty * piece.dx;
        if (piece.stroke == except || turn == 0) return false;
        const double x = piece.x - from.x, y = piece.y - from.y;
        const double distance = (x * piece.dy - y * piece.dx) / turn;
        const double share = (x * from.ty - y * from.tx) / turn;
        if (share >= 0 && share <= 1 && distance >= 0 && distance <= reach) least = std::min(least, distance);
        return false;
    });
    return least;
}

bool StrokeIndex::is_beside(const Piece& piece, const Along& along) const {
    const double length2 = piece.dx * piece.dx + piece.dy * piece.dy;
    if (!(length2 > 0)) return false;
    const double x = along.x - piece.x, y = along.y - piece.y;
    const double along_piece = (x * piece.dx + y * piece.dy) / length2;
    if ((piece.first && along_piece < 0) || (piece.last && along_piece > 1)) return false;
    const double share = std::clamp(along_piece, 0.0, 1.0);
    const double off_x = x - share * piece.dx, off_y = y - share * piece.dy;
    if (off_x * off_x + off_y * off_y >= within_ * within_) return false;
    // Before or behind a piece is beside it only in the bend outside of it and the next.
    const double length = std::sqrt(length2), beyond = std::fabs(along_piece - share) * length;
    if (beyond > kBend * std::fabs(x * piece.dy - y * piece.dx) / length) return false;
    const double cosine = (along.tx * piece.dx + along.ty * piece.dy) / length;
    return (along.kind == piece.kind ? cosine : std::fabs(cosine)) > kSameWay;
}

}  // namespace keyline
