// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/stroke_sharpness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace keyline {

namespace {

// To 2e-6: by Hastings' polynomial, Abramowitz and Stegun 4.4.46.
double arc_cosine_degrees(double cosine) {
    constexpr double kDegree = 57.295779513082323;
    constexpr std::array kTerms{-0.0012624911, 0.0066700901, -0.0170881256, 0.0308918810,
                                -0.0501743046, 0.0889789874, -0.2145988016, 1.5707963050};
    const double x = std::min(std::fabs(cosine), 1.0);
    double sum = 0;
    for (const double term : kTerms) sum = sum * x + term;
    const double angle = std::sqrt(1 - x) * sum * kDegree;
    return cosine < 0 ? 180 - angle : angle;
}

// Normals beside strokes on one side of them.
class Normals {
public:
    Normals(const Inputs& in, int first)
        : axes_{SampleReader(in.datum<StrokeSamples>(first)),
                SampleReader(in.datum<StrokeSamples>(first + 1)),
                SampleReader(in.datum<StrokeSamples>(first + 2))} {}

    // Of length 1; nothing where there is no surface.
    std::optional<std::array<double, 3>> at(uint32_t stroke, uint32_t vertex) {
        std::array<double, 3> n{};
        double square = 0;
        for (std::size_t i = 0; i < n.size(); ++i) {
            n[i] = double{axes_[i].at(stroke, vertex).value_or(0)};
            square += n[i] * n[i];
        }
        if (!(square > kLeast && std::isfinite(square))) return {};
        for (double& axis : n) axis /= std::sqrt(square);
        return n;
    }

private:
    static constexpr double kLeast = 1e-6;  // of a pixel that nearly nothing covers
    std::array<SampleReader, 3> axes_;
};

}  // namespace

Strokes TakeSharpness::derive(const Inputs& in) {
    Strokes out = in.datum<Strokes>(0);
    Normals near(in, 1), far(in, 4);
    for (uint32_t s = 0; s < out.strokes.size(); ++s)
        for (uint32_t i = 0; i < out.strokes[s].vertices.size(); ++i) {
            const auto a = near.at(s, i), b = far.at(s, i);
            if (!a) continue;
            double& sharpness = out.strokes[s].vertices[i].sharpness;
            sharpness =
                b ? arc_cosine_degrees((*a)[0] * (*b)[0] + (*a)[1] * (*b)[1] + (*a)[2] * (*b)[2]) : 180;
        }
    return out;
}

Stream with_sharpness(Builder& builder, const Stream& strokes, const Stream& normals) {
    const std::vector<ValueRef> axes = take_channels(builder, normals, named("X", "Y", "Z"));
    std::vector<Stream> links{strokes};
    for (const FindPlacesBeside::Side side : {FindPlacesBeside::kNear, FindPlacesBeside::kFar}) {
        const Stream beside = add_operation(builder, FindPlacesBeside{side}, {strokes});
        for (const ValueRef& axis : axes) {
            Stream image = normals;
            image.channels.clear();
            image.set("Y", axis);
            links.push_back(add_operation(builder, SampleBeside{}, {image, beside}));
        }
    }
    return add_operation(builder, TakeSharpness{}, links);
}

}  // namespace keyline
