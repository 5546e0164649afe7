// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/line_values.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <span>

namespace keyline {

namespace {

Along between(double a, double b) { return {a, b - a}; }

// A depth of 0 is not known: then the other's is taken.
Along between_depths(double a, double b) { return between(a > 0 ? a : b, b > 0 ? b : a); }

void add(LinePlaces& places, const Stroke& s, uint32_t index) {
    const std::size_t n = s.vertices.size();
    for (std::size_t i = 0; i + (s.closed ? 0 : 1) < n; ++i) {
        const StrokeVertex &a = s.vertices[i], &b = s.vertices[(i + 1) % n];
        places.pieces.add(a.x, a.y, b.x - a.x, b.y - a.y,
                          {index, between(a.x, b.x), between(a.y, b.y), between(a.u, i + 1 < n ? b.u : 1),
                           between(a.width, b.width), between_depths(a.depth, b.depth)});
        places.widest = std::max({places.widest, a.width, b.width});
    }
}

struct Most {
    float cover = 0;
    uint32_t stroke = 0;
};

void find_most(const Ink& ink, const Rect& rect, int y, std::span<Most> row) {
    std::ranges::fill(row, Most{});
    for (const InkSpan& span : ink.row(y))
        for (int x = std::max(span.x0, rect.x0); x < std::min(span.x1, rect.x1); ++x) {
            const float cover =
                ink.covers[span.first + (span.even ? 0 : static_cast<std::size_t>(x - span.x0))];
            Most& most = row[static_cast<std::size_t>(x - rect.x0)];
            if (cover > most.cover) most = {cover, span.stroke};
        }
}

}  // namespace

LinePlaces line_places(const Strokes& strokes) {
    LinePlaces out;
    for (const Stroke& s : strokes.strokes) {
        add(out, s, static_cast<uint32_t>(out.owners.size()));
        out.owners.push_back(s.near);
    }
    return out;
}

std::optional<LinePlaces::Place> LinePlaces::nearest(uint32_t stroke, double x, double y) const {
    constexpr double kPixel = 1.5;  // a pixel that a stroke covers is no farther from its discs
    double least = std::numeric_limits<double>::infinity();
    std::optional<Place> out;
    pieces.any_near(x, y, widest / 2 + kPixel, [&](const Piece& p) {
        if (p.stroke != stroke) return false;
        const double square = p.x.by * p.x.by + p.y.by * p.y.by, dx = x - p.x.from, dy = y - p.y.from;
        const double share = square > 0 ? std::clamp((dx * p.x.by + dy * p.y.by) / square, 0.0, 1.0) : 0;
        const double off_x = x - p.x.at(share), off_y = y - p.y.at(share),
                     off = off_x * off_x + off_y * off_y;
        if (off >= least) return false;
        least = off;
        const double width = p.width.at(share), half = width / 2;
        const double right = square > 0 ? (off_y * p.x.by - off_x * p.y.by) / std::sqrt(square) : 0;
        out = Place{p.u.at(share), width, p.depth.at(share),
                    half > 0 ? std::clamp(right / half, -1.0, 1.0) : 0};
        return false;
    });
    return out;
}

void LayLineValues::compute(const Inputs& in, Outputs out, Scratch& scratch) {
    const Ink& ink = in.datum<Ink>(0);
    const auto& places = in.datum<LinePlaces>(1);
    const Rect& rect = out[0].rect;
    const std::span<Most> row = scratch.take<Most>(static_cast<std::size_t>(rect.width()));
    for (int y = rect.y0; y < rect.y1; ++y) {
        find_most(ink, rect, y, row);
        for (int x = rect.x0; x < rect.x1; ++x) {
            const Most& most = row[static_cast<std::size_t>(x - rect.x0)];
            const bool covered = most.cover > 0;
            const auto place = covered ? places.nearest(most.stroke, x + 0.5, y + 0.5) : std::nullopt;
            const LinePlaces::Place at = place.value_or(LinePlaces::Place{});
            const std::array<float, outputs.size()> values{
                most.cover,
                std::bit_cast<float>(covered ? places.owners[most.stroke] : 0),
                std::bit_cast<float>(covered ? most.stroke + 1 : 0),
                static_cast<float>(at.u),
                static_cast<float>(at.across),
                static_cast<float>(at.width),
                static_cast<float>(at.depth),
                0};
            for (std::size_t c = 0; c < values.size(); ++c) *out[c].at(x, y) = values[c];
        }
    }
}

}  // namespace keyline
