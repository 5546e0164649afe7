// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/stroke_doubles.h"

#include "engine/kit/stroke_index.h"
#include "engine/kit/stroke_way.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace keyline {

namespace {

constexpr std::size_t kCrumb = 3;  // vertices between two doubles that are no line of their own

StrokeIndex::Along along_at(const Stroke& s, std::size_t i) {
    const StrokeVertex& v = s.vertices[i];
    const StrokeWay way = way_at(s, i);
    if (!(way.length > 0)) return {v.x, v.y, 0, 0, s.kind};
    return {v.x, v.y, way.x / way.length, way.y / way.length, s.kind};
}

// An end that only touches another line is no double.
std::vector<bool> find_doubles(const Stroke& stroke, const StrokeIndex& before) {
    const std::size_t n = stroke.vertices.size();
    std::vector<bool> out;
    for (std::size_t i = 0; i < n; ++i) out.push_back(before.has(along_at(stroke, i)));
    if (!stroke.closed && n > 2) {
        out[0] = out[0] && out[1];
        out[n - 1] = out[n - 1] && out[n - 2];
    }
    return out;
}

// So that it begins with a vertex that goes: its parts then lie in one row.
void open_at_double(Stroke& stroke, std::vector<bool>& doubles) {
    const auto first = std::ranges::find(doubles, true) - doubles.begin();
    std::rotate(stroke.vertices.begin(), stroke.vertices.begin() + first, stroke.vertices.end());
    std::rotate(doubles.begin(), doubles.begin() + first, doubles.end());
    stroke.vertices.push_back(stroke.vertices.front());
    doubles.push_back(true);
    stroke.closed = false;
    stroke.ends = {};
}

// The part from `begin` up to `end`, with the first vertex that goes on either side: it touches the other
// line.
Stroke part_of(const Stroke& stroke, std::size_t begin, std::size_t end) {
    Stroke out = stroke;
    const std::size_t n = stroke.vertices.size();
    if (begin > 0) out.ends[0] = StrokeEnd::kJoined;
    if (end < n) out.ends[1] = StrokeEnd::kJoined;
    const auto at = [&](std::size_t i) { return stroke.vertices.begin() + static_cast<std::ptrdiff_t>(i); };
    out.vertices.assign(at(begin > 0 ? begin - 1 : 0), at(std::min(end + 1, n)));
    return out;
}

// Whether a part goes on, at an end that the stroke had, to where lines meet.
bool leads_on(const Stroke& stroke, std::size_t begin, std::size_t end) {
    return (begin == 0 && stroke.ends[0] != StrokeEnd::kEnd) ||
           (end == stroke.vertices.size() && stroke.ends[1] != StrokeEnd::kEnd);
}

}  // namespace

std::vector<Stroke> without_doubles(std::vector<Stroke> strokes, double within, double least) {
    if (!(within > 0)) return strokes;
    StrokeIndex kept(within);
    std::vector<Stroke> out;
    for (Stroke& stroke : strokes) {
        std::vector<bool> doubles = find_doubles(stroke, kept);
        if (std::ranges::count(doubles, true) == 0) {
            out.push_back(std::move(stroke));
            kept.add(out.back());
            continue;
        }
        if (stroke.closed) open_at_double(stroke, doubles);
        const std::size_t n = doubles.size();
        for (std::size_t begin = 0; begin < n;) {
            std::size_t end = begin;
            while (end < n && !doubles[end]) ++end;
            Stroke part = part_of(stroke, begin, end);
            if (end - begin >= kCrumb && (leads_on(stroke, begin, end) || length_of(part) >= least)) {
                kept.add(part);
                out.push_back(std::move(part));
            }
            begin = end + 1;
        }
    }
    return out;
}

}  // namespace keyline
