// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/stroke_samples.h"

#include "engine/kit/stroke_way.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace keyline {

namespace {

constexpr double kBeside = 2.5;  // pixels

// The near side is on the right of the stroke's way.
PlacesBeside::Place beside(const Stroke& s, std::size_t i, FindPlacesBeside::Side side) {
    const StrokeWay way = way_at(s, i);
    const double length = side == FindPlacesBeside::kNear ? way.length : -way.length;
    const double aside = way.length > 0 ? kBeside / length : 0;
    return {.y = static_cast<int>(std::floor(s.vertices[i].y + aside * way.x)),
            .x = static_cast<int>(std::floor(s.vertices[i].x - aside * way.y))};
}

}  // namespace

PlacesBeside FindPlacesBeside::derive(const Inputs& in) const {
    const std::vector<Stroke>& strokes = in.datum<Strokes>(0).strokes;
    PlacesBeside out;
    for (std::size_t s = 0; s < strokes.size(); ++s)
        for (std::size_t i = 0; i < strokes[s].vertices.size(); ++i) {
            PlacesBeside::Place place = beside(strokes[s], i, side);
            place.stroke = static_cast<uint32_t>(s);
            place.vertex = static_cast<uint32_t>(i);
            out.places.push_back(place);
        }
    std::ranges::sort(out.places);
    return out;
}

SampleBeside::Partial SampleBeside::map(const State&, const Inputs& in, const Rect& block, Scratch&) {
    const View& image = in.slot(0)[0];
    const std::vector<PlacesBeside::Place>& places = in.datum<PlacesBeside>(1).places;
    Partial out;
    auto next = places.begin();
    for (int y = block.y0; y < block.y1; ++y) {
        next = std::lower_bound(next, places.end(), PlacesBeside::Place{.y = y, .x = block.x0});
        for (; next != places.end() && next->y == y && next->x < block.x1; ++next)
            out.push_back({next->stroke, next->vertex, *image.at(next->x, y)});
    }
    return out;
}

StrokeSamples SampleBeside::finish(State state) {
    std::ranges::sort(state, {}, [](const StrokeSample& s) { return std::tuple(s.stroke, s.vertex); });
    return {std::move(state)};
}

}  // namespace keyline
