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
        rows_.resize(static_cast<std::size_t>(window.height()));
        const std::size_t n = stroke.vertices.size();
        for (std::size_t i = 0; i + (stroke.closed ? 0 : 1) < n; ++i) {
            const StrokeVertex &a = at(i), &b = at(i + 1);
            const double reach = reach_of(a, b);
            const int from = row_of(std::min(a.y, b.y) - reach), to = row_of(std::max(a.y, b.y) + reach);
            for (int y = from; y <= to && y < window.y1; ++y)
                rows_[static_cast<std::size_t>(y - window.y0)].push_back(i);
        }
    }

    double at_pixel(int x, int y) const {
        const double px = x + 0.5, py = y + 0.5;
        double nearest = std::numeric_limits<double>::infinity(), opacity = 0;
        for (const std::size_t i : rows_[static_cast<std::size_t>(y - window_.y0)]) {
            const StrokeVertex &a = at(i), &b = at(i + 1);
            const double reach = reach_of(a, b);
            if (px < std::min(a.x, b.x) - reach || px > std::max(a.x, b.x) + reach) continue;
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
    const StrokeVertex& at(std::size_t i) const { return stroke_.vertices[i % stroke_.vertices.size()]; }
    // The centre of a pixel that is covered lies no farther from the way.
    static double reach_of(const StrokeVertex& a, const StrokeVertex& b) {
        return std::max(a.width, b.width) / 2 + 1;
    }
    int row_of(double y) const {
        return static_cast<int>(std::clamp(std::floor(y), double(window_.y0), double(window_.y1)));
    }

    const Stroke& stroke_;
    Rect window_;
    std::vector<std::vector<std::size_t>> rows_;  // the segments near each row
};

// Puts the strokes' spans in a row each, in the order in which they come.
class InkMaker {
public:
    explicit InkMaker(const Rect& window) { ink_.window = window; }

    void add(const Stroke& stroke, const Ink::Colour& colour) {
        const Coverage coverage = coverage_of(outline_of(stroke), ink_.window);
        const auto index = static_cast<uint32_t>(ink_.colours.size());
        ink_.colours.push_back(colour);
        if (is_even(stroke)) return add_even(coverage, index, static_cast<float>(stroke.vertices[0].opacity));
        const NearestOpacity opacity(stroke, ink_.window);
        for (const CoverageSpan& s : coverage.spans) {
            begin(s, index, false);
            for (int x = s.x0; x < s.x1; ++x)
                ink_.covers.push_back(cover(coverage, s, x) * static_cast<float>(opacity.at_pixel(x, s.y)));
        }
    }

    Ink take() {
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
    std::vector<Found> found_;
};

}  // namespace

std::size_t Ink::bytes() const {
    return spans.size() * sizeof(InkSpan) + rows.size() * sizeof(std::size_t) +
           covers.size() * sizeof(float) + colours.size() * sizeof(Colour);
}

Ink ink_of(const Strokes& strokes, const Rect& window, const Color& color) {
    InkMaker maker(window);
    for (const Stroke& s : strokes.strokes) {
        const Color c = s.color.value_or(color);
        maker.add(s, {static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b)});
    }
    return maker.take();
}

}  // namespace keyline
