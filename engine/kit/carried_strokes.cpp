// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/carried_strokes.h"

#include "engine/kit/stroke_way.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace keyline {

namespace {

using Way = StrokeWays::Way;

constexpr std::array kInside{1.5, 2.5};  // pixels from a line, where samples are not mixed
constexpr std::array kMiddle{0.0, 2.5};  // of something thin: on it, and beside it

std::size_t vertices_of(const Strokes& strokes) {
    std::size_t sum = 0;
    for (const Stroke& s : strokes.strokes) sum += s.vertices.size();
    return sum;
}

// visit(vertex, its place among all) in order.
template <class List, class Visit>
void for_each_vertex(List& strokes, const Visit& visit) {
    std::size_t i = 0;
    for (auto& s : strokes)
        for (auto& v : s.vertices) visit(v, i++);
}

// A vertex whose way was not known stands nowhere, at NaN, which min and max pass over.
Rect bounds_of(const Stroke& s) {
    static constexpr double kFar = 1e9;
    double x0 = kFar, x1 = -kFar, y0 = kFar, y1 = -kFar;
    for (const StrokeVertex& v : s.vertices) {
        x0 = std::min(x0, v.x), x1 = std::max(x1, v.x);
        y0 = std::min(y0, v.y), y1 = std::max(y1, v.y);
    }
    const auto whole = [](double d) { return static_cast<int>(std::floor(std::clamp(d, -kFar, kFar))); };
    const double reach = kInside.back() + 1;
    return {whole(x0 - reach), whole(y0 - reach), whole(x1 + reach) + 1, whole(y1 + reach) + 1};
}

struct Direction {
    double x = 0, y = 0;
};

// One pixel to the right of the stroke's way; nowhere where it has none.
Direction inwards(const Stroke& s, std::size_t i) {
    const StrokeWay way = way_at(s, i);
    return way.length > 0 ? Direction{-way.y / way.length, way.x / way.length} : Direction{};
}

// Of something thin, as it is a renderer's accident whether a pixel shows it.
bool is_middle(const Stroke& s, const StrokeVertex& v) {
    return s.kind == StrokeKind::kRidge && v.thickness > 0;
}

// What is found at a vertex: near the line and farther from it.
struct Seen {
    uint32_t stroke = 0;
    bool is_middle = false;
    std::array<Way, 2> ways;

    double apart() const {
        const double x = ways[0].x - ways[1].x, y = ways[0].y - ways[1].y;
        return ways[0].is_known && ways[1].is_known ? std::sqrt(x * x + y * y) : 0;
    }
};

// Along its middle a thin thing moves as where it is seen best: where motion differs most from that beside
// it.
Way of_middle(const std::vector<Seen>& seen, std::size_t vertex) {
    constexpr std::size_t kAlong = 4;  // vertices
    const Seen* best = &seen[vertex];
    for (std::size_t k = 1; k <= kAlong; ++k)
        for (const std::size_t i : {vertex - std::min(vertex, k), std::min(vertex + k, seen.size() - 1)})
            if (seen[i].is_middle && seen[i].stroke == best->stroke && seen[i].apart() > best->apart())
                best = &seen[i];
    return best->ways[0];
}

// Motion changes along a surface, so it is carried on to the line where the surface goes on that far.
Way at_line(const Way& near, const Way& farther) {
    if (!near.is_known || !farther.is_known) return near;
    constexpr double kOneSurface = 0.25;  // pixels
    const double x = near.x - farther.x, y = near.y - farther.y;
    if (std::sqrt(x * x + y * y) > kOneSurface) return near;
    constexpr double kBack = kInside[0] / (kInside[1] - kInside[0]);
    return {near.x + kBack * x, near.y + kBack * y, true};
}

}  // namespace

CarriedStrokes BeginCarrying::derive(const Inputs& in) {
    const auto& strokes = in.datum<Strokes>(0);
    return {strokes, std::vector<uint8_t>(vertices_of(strokes), 1)};
}

FindWays::Partial FindWays::map(const State&, const Inputs& in, const Rect& block, Scratch&) const {
    const std::span<const View> image = in.slot(0);
    Partial out;
    uint32_t first = 0, stroke = 0;
    for (const Stroke& s : in.datum<CarriedStrokes>(1).strokes.strokes) {
        const auto n = static_cast<uint32_t>(s.vertices.size());
        if (!intersect(bounds_of(s), block).empty())
            for (uint32_t i = 0; i < n; ++i) {
                const Direction inside = inwards(s, i);
                const bool middle = is_middle(s, s.vertices[i]);
                const std::array<double, 2>& far = middle ? kMiddle : kInside;
                for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
                    const double x = std::floor(s.vertices[i].x + far[k] * inside.x),
                                 y = std::floor(s.vertices[i].y + far[k] * inside.y);
                    if (!(x >= block.x0 && x < block.x1 && y >= block.y0 && y < block.y1)) continue;
                    const auto channel = [&](std::size_t c) {
                        return *image[c].at(static_cast<int>(x), static_cast<int>(y));
                    };
                    out.push_back({first + i, stroke, middle, k == 1, to_next ? -channel(2) : channel(0),
                                   to_next ? channel(3) : -channel(1)});
                }
            }
        first += n;
        ++stroke;
    }
    return out;
}

StrokeWays FindWays::finish(State state) {
    std::ranges::sort(state, {}, [](const Sample& s) { return std::tuple(s.vertex, s.is_farther); });
    std::vector<Seen> seen(state.empty() ? 0 : state.back().vertex + 1);
    for (const Sample& s : state) {
        Seen& of = seen[s.vertex];
        of.stroke = s.stroke;
        of.is_middle = s.is_middle;
        of.ways[s.is_farther ? 1 : 0] = {double{s.x}, double{s.y}, std::isfinite(s.x) && std::isfinite(s.y)};
    }
    StrokeWays out;
    for (std::size_t i = 0; i < seen.size(); ++i)
        out.ways.push_back(seen[i].is_middle ? of_middle(seen, i)
                                             : at_line(seen[i].ways[0], seen[i].ways[1]));
    return out;
}

CarriedStrokes GoWays::derive(const Inputs& in) {
    CarriedStrokes out = in.datum<CarriedStrokes>(0);
    const std::vector<Way>& ways = in.datum<StrokeWays>(1).ways;
    for_each_vertex(out.strokes.strokes, [&](StrokeVertex& v, std::size_t i) {
        const Way way = i < ways.size() ? ways[i] : Way{};
        v.x += way.x;
        v.y += way.y;
        out.seen[i] &= static_cast<uint8_t>(way.is_known);
    });
    return out;
}

CarriedStrokes DropHidden::derive(const Inputs& in) {
    CarriedStrokes out = in.datum<CarriedStrokes>(0);
    const std::vector<Way>&there = in.datum<StrokeWays>(1).ways, &back = in.datum<StrokeWays>(2).ways;
    constexpr double kSamePlace = 0.5;  // pixels
    for (std::size_t i = 0; i < out.seen.size(); ++i) {
        const bool known = i < there.size() && i < back.size() && back[i].is_known;
        const double x = known ? there[i].x + back[i].x : 0, y = known ? there[i].y + back[i].y : 0;
        if (!known || std::sqrt(x * x + y * y) >= kSamePlace) out.seen[i] = 0;
    }
    return out;
}

}  // namespace keyline
