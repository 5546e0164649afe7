// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/measure/spots.h"

#include <algorithm>

namespace keyline {

namespace {

void add_piece(std::vector<Spot>& out, const StrokeVertex& a, const StrokeVertex& b, std::size_t stroke,
               double& arc) {
    const double dx = b.x - a.x, dy = b.y - a.y, length = std::sqrt(dx * dx + dy * dy);
    if (!(length > 0)) return;
    const int count = static_cast<int>(std::ceil(length / kSpotLength));
    for (int i = 0; i < count; ++i) {
        const double t = (i + 0.5) / count;
        out.push_back({a.x + t * dx, a.y + t * dy, dx / length, dy / length, length / count, arc + t * length,
                       a.width + t * (b.width - a.width), stroke});
    }
    arc += length;
}

}  // namespace

std::vector<Spot> spots_of(const Strokes& drawing) {
    std::vector<Spot> out;
    for (std::size_t s = 0; s < drawing.strokes.size(); ++s) {
        const Stroke& stroke = drawing.strokes[s];
        const std::vector<StrokeVertex>& v = stroke.vertices;
        double arc = 0;
        for (std::size_t i = 1; i < v.size(); ++i) add_piece(out, v[i - 1], v[i], s, arc);
        if (stroke.closed && v.size() > 1) add_piece(out, v.back(), v.front(), s, arc);
    }
    return out;
}

SpotIndex::SpotIndex(const std::vector<Spot>& spots) {
    for (std::size_t i = 0; i < spots.size(); ++i)
        cells_[key(cell_of(spots[i].x), cell_of(spots[i].y))].push_back(i);
}

}  // namespace keyline
