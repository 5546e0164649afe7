// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/stroke_anchors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace keyline {

namespace {

using Anchor = std::array<double, 3>;

// Coordinates beside strokes, read in the order of their vertices.
class Places {
public:
    explicit Places(const Inputs& in)
        : axes_{SampleReader(in.datum<StrokeSamples>(1)), SampleReader(in.datum<StrokeSamples>(2)),
                SampleReader(in.datum<StrokeSamples>(3))} {}

    // Nothing outside the image, and where it holds no number.
    std::optional<Anchor> at(uint32_t stroke, uint32_t vertex) {
        std::array<std::optional<float>, 3> found;
        for (std::size_t i = 0; i < axes_.size(); ++i) found[i] = axes_[i].at(stroke, vertex);
        if (!found[0]) return {};
        Anchor out{};
        for (std::size_t i = 0; i < out.size(); ++i) out[i] = double{found[i].value_or(0)};
        if (!std::ranges::all_of(out, [](double c) { return std::isfinite(c); })) return {};
        return out;
    }

private:
    std::array<SampleReader, 3> axes_;
};

}  // namespace

Strokes TakeAnchors::derive(const Inputs& in) const {
    Strokes out = in.datum<Strokes>(0);
    Places places(in);
    for (uint32_t s = 0; s < out.strokes.size(); ++s) {
        Stroke& stroke = out.strokes[s];
        std::vector<std::optional<Anchor>> found;
        for (uint32_t i = 0; i < stroke.vertices.size(); ++i) found.push_back(places.at(s, i));
        const auto first = std::ranges::find_if(found, [](const auto& f) { return f.has_value(); });
        if (first == found.end()) continue;
        stroke.anchor = kind;
        Anchor last = **first;
        for (std::size_t i = 0; i < found.size(); ++i)
            stroke.vertices[i].anchor = last = found[i].value_or(last);
    }
    return out;
}

Stream with_anchors(Builder& builder, const Stream& strokes, const Stream& places) {
    std::vector<Stream> links{strokes};
    const Stream beside = add_operation(builder, FindPlacesBeside{}, {strokes});
    for (const StreamChannel& axis : places.channels) {
        Stream image = places;
        image.channels.clear();
        image.set("Y", axis);
        links.push_back(add_operation(builder, SampleBeside{}, {image, beside}));
    }
    const bool flat = links.size() < 4;
    if (flat) links.push_back(add_operation(builder, NoSamples{}, {}));
    return add_operation(builder, TakeAnchors{flat ? StrokeAnchor::kUv : StrokeAnchor::kPosition}, links);
}

}  // namespace keyline
