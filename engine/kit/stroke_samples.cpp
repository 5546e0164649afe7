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

struct Pixel {
    int x = 0, y = 0;
};

// The near side is on the right of the stroke's way.
Pixel beside(const Stroke& s, std::size_t i, SampleBeside::Side side) {
    const StrokeWay way = way_at(s, i);
    const double length = side == SampleBeside::kNear ? way.length : -way.length;
    const double aside = way.length > 0 ? kBeside / length : 0;
    return {static_cast<int>(std::floor(s.vertices[i].x - aside * way.y)),
            static_cast<int>(std::floor(s.vertices[i].y + aside * way.x))};
}

}  // namespace

SampleBeside::Partial SampleBeside::map(const State&, const Inputs& in, const Rect& block, Scratch&) const {
    const View& image = in.slot(0)[0];
    const std::vector<Stroke>& strokes = in.datum<Strokes>(1).strokes;
    Partial out;
    for (std::size_t s = 0; s < strokes.size(); ++s)
        for (std::size_t i = 0; i < strokes[s].vertices.size(); ++i) {
            const Pixel at = beside(strokes[s], i, side);
            if (block.contains(at.x, at.y))
                out.push_back({static_cast<uint32_t>(s), static_cast<uint32_t>(i), *image.at(at.x, at.y)});
        }
    return out;
}

StrokeSamples SampleBeside::finish(State state) {
    std::ranges::sort(state, {}, [](const StrokeSample& s) { return std::tuple(s.stroke, s.vertex); });
    return {std::move(state)};
}

}  // namespace keyline
