// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/measure/spots.h"

#include <algorithm>

namespace keyline {

namespace {

constexpr double kAround = 16;  // pixels around the data window that are looked at

// Which part of the way from `from` by `by` lies between two bounds.
struct Part {
    double first = 0, last = 1;
    void keep(double from, double by, double least, double most) {
        if (by == 0) {
            if (from < least || from > most) last = 0;
            return;
        }
        const double a = (least - from) / by, b = (most - from) / by;
        first = std::max(first, std::min(a, b));
        last = std::min(last, std::max(a, b));
    }
};

void add_piece(std::vector<Spot>& out, const StrokeVertex& a, const StrokeVertex& b, std::size_t stroke,
               const Rect& window, bool is_middle, double& arc) {
    const double dx = b.x - a.x, dy = b.y - a.y, length = std::sqrt(dx * dx + dy * dy);
    if (!(length > 0)) return;
    Part part;
    part.keep(a.x, dx, window.x0 - kAround, window.x1 + kAround);
    part.keep(a.y, dy, window.y0 - kAround, window.y1 + kAround);
    const double share = part.last - part.first;
    const int count = share > 0 ? static_cast<int>(std::ceil(share * length / kSpotLength)) : 0;
    for (int i = 0; i < count; ++i) {
        const double t = part.first + share * (i + 0.5) / count;
        out.push_back({a.x + t * dx, a.y + t * dy, dx / length, dy / length, share * length / count,
                       arc + t * length, a.width + t * (b.width - a.width), stroke, is_middle});
    }
    arc += length;
}

}  // namespace

std::vector<Spot> spots_of(const Strokes& drawing) {
    std::vector<Spot> out;
    for (std::size_t s = 0; s < drawing.strokes.size(); ++s) {
        const Stroke& stroke = drawing.strokes[s];
        const std::vector<StrokeVertex>& v = stroke.vertices;
        const auto is_middle = [&](const StrokeVertex& a) {
            return stroke.kind == StrokeKind::kRidge && a.thickness > 0;
        };
        double arc = 0;
        for (std::size_t i = 1; i < v.size(); ++i)
            add_piece(out, v[i - 1], v[i], s, drawing.window, is_middle(v[i]), arc);
        if (stroke.closed && v.size() > 1)
            add_piece(out, v.back(), v.front(), s, drawing.window, is_middle(v.back()), arc);
    }
    return out;
}

SpotIndex::SpotIndex(const std::vector<Spot>& spots) {
    for (std::size_t i = 0; i < spots.size(); ++i)
        cells_[key(cell_of(spots[i].x), cell_of(spots[i].y))].push_back(i);
}

}  // namespace keyline
