// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/ink.h"

#include "engine/kit/coverage.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace keyline {

namespace {

bool is_even(const Stroke& s) {
    return std::ranges::all_of(s.vertices, [&](const auto& v) { return v.opacity == s.vertices[0].opacity; });
}

// The opacity of the nearest place on a stroke's way.
class NearestOpacity {
public:
    NearestOpacity(const Stroke& stroke, const Rect& window) : stroke_(stroke), window_(window) {
        const std::size_t n = stroke.vertices.size();
        for (std::size_t i = 0; i + (stroke.closed ? 0 : 1) < n; ++i) add(i);
        std::ranges::sort(near_);
    }

    double at_pixel(int x, int y) const {
        const double px = x + 0.5, py = y + 0.5;
        double nearest = std::numeric_limits<double>::infinity(), opacity = 0;
        const uint64_t cell = cell_at(y, x / kCell);
        for (auto it = std::ranges::lower_bound(near_, std::pair(cell, std::size_t{0}));
             it != near_.end() && it->first == cell; ++it) {
            const StrokeVertex &a = at(it->second), &b = at(it->second + 1);
            const double dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
            const double along = square > 0 ? ((px - a.x) * dx + (py - a.y) * dy) / square : 0;
            const double t = std::clamp(along, 0.0, 1.0);
            const double ex = a.x + t * dx - px, ey = a.y + t * dy - py, distance = ex * ex + ey * ey;
            if (distance >= nearest) continue;
            nearest = distance;
            opacity = a.opacity + t * (b.opacity - a.opacity);
        }
        return opacity;
    }

private:
    static constexpr int kCell = 8;  // pixels of a row

    static uint64_t cell_at(int y, int column) {
        return uint64_t{static_cast<uint32_t>(y)} << 32 | static_cast<uint32_t>(column);
    }

    // To the cells in which pixels may be nearest to the way from vertex i on.
    void add(std::size_t i) {
        const StrokeVertex &a = at(i), &b = at(i + 1);
        const double reach = std::max(a.width, b.width) / 2 + 1;
        const int top = whole(std::min(a.y, b.y) - reach, window_.y0, window_.y1),
                  bottom = whole(std::max(a.y, b.y) + reach, window_.y0, window_.y1);
        for (int y = top; y <= bottom; ++y) {
            // Where it passes the row, and what is in reach of that.
            const double from = x_at(a, b, y - reach), to = x_at(a, b, y + 1 + reach);
            const int left = whole(std::min(from, to) - reach, window_.x0, window_.x1),
                      right = whole(std::max(from, to) + reach, window_.x0, window_.x1);
            for (int column = left / kCell; column <= right / kCell; ++column)
                near_.emplace_back(cell_at(y, column), i);
        }
    }

    static int whole(double d, int from, int to) {
        return static_cast<int>(std::clamp(std::floor(d), double(from), double(to - 1)));
    }

    // On the way from a to b, or where that ends.
    static double x_at(const StrokeVertex& a, const StrokeVertex& b, double y) {
        if (a.y == b.y) return y < a.y ? a.x : b.x;
        return a.x + std::clamp((y - a.y) / (b.y - a.y), 0.0, 1.0) * (b.x - a.x);
    }

    const StrokeVertex& at(std::size_t i) const { return stroke_.vertices[i % stroke_.vertices.size()]; }

    const Stroke& stroke_;
    Rect window_;
    std::vector<std::pair<uint64_t, std::size_t>> near_;  // in the order of cells, then along the way
};

// Puts the strokes' spans in a row each, in the order in which they come.
class InkMaker {
public:
    explicit InkMaker(const Rect& window) { ink_.window = window; }

    void add(const Stroke& stroke) {
        const Coverage coverage = coverage_of(outline_of(stroke), ink_.window);
        const uint32_t index = strokes_++;
        if (is_even(stroke)) return add_even(coverage, index, static_cast<float>(stroke.vertices[0].opacity));
        const NearestOpacity opacity(stroke, ink_.window);
        for (const CoverageSpan& s : coverage.spans) {
            begin(s, index, false);
            for (int x = s.x0; x < s.x1; ++x)
                ink_.covers.push_back(cover(coverage, s, x) * static_cast<float>(opacity.at_pixel(x, s.y)));
        }
    }

    Ink take(std::vector<Ink::Colour> colours) {
        ink_.colours = std::move(colours);
        std::ranges::stable_sort(found_, {}, &Found::y);
        ink_.rows.assign(static_cast<std::size_t>(ink_.window.height()) + 1, 0);
        for (const Found& f : found_) {
            ++ink_.rows[static_cast<std::size_t>(f.y - ink_.window.y0) + 1];
            ink_.spans.push_back(f.span);
        }
        for (std::size_t i = 1; i < ink_.rows.size(); ++i) ink_.rows[i] += ink_.rows[i - 1];
        return std::move(ink_);
    }

private:
    struct Found {
        int y = 0;
        InkSpan span;
    };

    static float cover(const Coverage& coverage, const CoverageSpan& s, int x) {
        return s.first == CoverageSpan::kWhole
                   ? 1
                   : coverage.covers[s.first + static_cast<std::size_t>(x - s.x0)];
    }

    void begin(const CoverageSpan& s, uint32_t stroke, bool even) {
        found_.push_back({s.y, {s.x0, s.x1, stroke, even, ink_.covers.size()}});
    }

    void add_even(const Coverage& coverage, uint32_t stroke, float opacity) {
        if (!(opacity > 0)) return;
        for (const CoverageSpan& s : coverage.spans) {
            const bool whole = s.first == CoverageSpan::kWhole;
            begin(s, stroke, whole);
            for (int x = s.x0; x < (whole ? s.x0 + 1 : s.x1); ++x)
                ink_.covers.push_back(cover(coverage, s, x) * opacity);
        }
    }

    Ink ink_;
    uint32_t strokes_ = 0;
    std::vector<Found> found_;
};

}  // namespace

std::size_t Ink::bytes() const {
    return spans.size() * sizeof(InkSpan) + rows.size() * sizeof(std::size_t) +
           covers.size() * sizeof(float) + colours.size() * sizeof(Colour);
}

Ink ink_of(const Strokes& strokes, const Rect& window, std::vector<Ink::Colour> colours) {
    InkMaker maker(window);
    for (const Stroke& s : strokes.strokes) maker.add(s);
    return maker.take(std::move(colours));
}

}  // namespace keyline
