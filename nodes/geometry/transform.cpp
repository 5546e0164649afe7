// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/base/index.h"
#include "engine/base/pixel_aspect.h"
#include "engine/kit/filter.h"
#include "engine/node/node_adaptor.h"
#include "engine/node/pixel_loop.h"
#include "engine/simd/elementary.h"

#include <algorithm>
#include <cmath>

namespace keyline {

namespace {

struct Point {
    double x, y;
};

// An affine map: (x, y) → (xx x + xy y + x0, yx x + yy y + y0).
struct Affine {
    double xx, xy, yx, yy, x0, y0;

    Point operator()(Point p) const { return {xx * p.x + xy * p.y + x0, yx * p.x + yy * p.y + y0}; }
};

// What an image was, from what it has become, and the filter it is seen through.
struct Sampling {
    Affine to_in;
    Filter filter;
    double stretch_x, stretch_y;  // of the filter, along the axes of the input

    Sampling(const Affine& map, Filter f)
        : to_in(map),
          filter(f),
          stretch_x(filter_stretch(f, std::sqrt(map.xx * map.xx + map.xy * map.xy))),
          stretch_y(filter_stretch(f, std::sqrt(map.yx * map.yx + map.yy * map.yy))) {}

    bool keeps_axes() const { return to_in.xy == 0 && to_in.yx == 0; }
    double reach_x() const { return filter_radius(filter) * stretch_x; }
    double reach_y() const { return filter_radius(filter) * stretch_y; }
};

// The pixels that the corners of a rectangle, grown by rx and ry, are mapped on.
Rect bounds(const Rect& r, double rx, double ry, const Affine& map) {
    const Point corners[] = {map({r.x0 - rx, r.y0 - ry}), map({r.x1 + rx, r.y0 - ry}),
                             map({r.x0 - rx, r.y1 + ry}), map({r.x1 + rx, r.y1 + ry})};
    const auto [x0, x1] = std::ranges::minmax(corners, {}, &Point::x);
    const auto [y0, y1] = std::ranges::minmax(corners, {}, &Point::y);
    return {nearest_pixel(std::floor(x0.x)), nearest_pixel(std::floor(y0.y)), nearest_pixel(std::ceil(x1.x)),
            nearest_pixel(std::ceil(y1.y))};
}

// Outside its data window the image is 0, so that its edges are antialiased.
struct Resampled {
    Rect demand(const Rect& out, int) const {
        const Rect seen = bounds(out, 0, 0, sampling.to_in);
        return grow(seen, {static_cast<int>(std::ceil(sampling.reach_x())) + 1,
                           static_cast<int>(std::ceil(sampling.reach_y())) + 1});
    }
    double cost() const { return 200; }

    void compute(const View& in, const MutView& out, Scratch& scratch) const {
        if (!exact && sampling.keeps_axes()) return compute_upright(in, out, scratch);
        const auto wx = scratch.take<double>(taps(sampling.reach_x())),
                   wy = scratch.take<double>(taps(sampling.reach_y()));
        for (int y = out.rect.y0; y < out.rect.y1; ++y)
            for (int x = out.rect.x0; x < out.rect.x1; ++x) {
                const Point at = sampling.to_in({x + 0.5, y + 0.5});
                if (exact) {
                    *out.at(x, y) = nearest(in, at);
                    continue;
                }
                const Taps tx{weigh_x(at, wx), wx}, ty{weigh_y(at, wy), wy};
                *out.at(x, y) = with_one_nan(sample(in, tx, ty));
            }
    }

    Sampling sampling;
    bool exact = false;  // the bits of the nearest pixel, whatever they stand for

private:
    static float nearest(const View& in, Point at) {
        const int x = static_cast<int>(std::ceil(at.x)) - 1, y = static_cast<int>(std::ceil(at.y)) - 1;
        return in.rect.contains(x, y) ? *in.at(x, y) : 0;
    }

    // Pixels of one axis of the input from `first` on, and their weights.
    struct Taps {
        int first;
        std::span<const double> weights;
        int end() const { return first + static_cast<int>(weights.size()); }
    };

    // Unturned, all pixels of a column have the weights in x, and those of a row the weights in y: weighing
    // costs more than summing.
    void compute_upright(const View& in, const MutView& out, Scratch& scratch) const {
        const std::size_t n = taps(sampling.reach_x()), width = static_cast<std::size_t>(out.rect.width());
        const auto wx = scratch.take<double>(n * width), wy = scratch.take<double>(taps(sampling.reach_y()));
        const auto first = scratch.take<int>(width);
        const auto in_of = [&](std::size_t i, int y) {
            return sampling.to_in({out.rect.x0 + static_cast<int>(i) + 0.5, y + 0.5});
        };
        for (std::size_t i = 0; i < width; ++i)
            first[i] = weigh_x(in_of(i, out.rect.y0), wx.subspan(i * n, n));
        for (int y = out.rect.y0; y < out.rect.y1; ++y) {
            const Taps ty{weigh_y(in_of(0, y), wy), wy};
            for (std::size_t i = 0; i < width; ++i)
                out.row(y)[i] = with_one_nan(sample(in, {first[i], wx.subspan(i * n, n)}, ty));
        }
    }

    static std::size_t taps(double reach) { return static_cast<std::size_t>(2 * std::ceil(reach)) + 2; }

    static float sample(const View& in, const Taps& tx, const Taps& ty) {
        const int left = std::max(tx.first, in.rect.x0), right = std::min(tx.end(), in.rect.x1);
        const int top = std::max(ty.first, in.rect.y0), bottom = std::min(ty.end(), in.rect.y1);
        double sum = 0;
        for (int y = top; y < bottom; ++y)
            for (int x = left; x < right; ++x) {
                const double w = tx.weights[index(x - tx.first)] * ty.weights[index(y - ty.first)];
                // A weight of 0 takes nothing, not even NaN or infinity.
                if (w != 0) sum += w * double{*in.at(x, y)};
            }
        return static_cast<float>(sum);
    }

    int weigh_x(Point at, std::span<double> weights) const {
        return weigh(at.x - 0.5, sampling.stretch_x, sampling.reach_x(), weights);
    }
    int weigh_y(Point at, std::span<double> weights) const {
        return weigh(at.y - 0.5, sampling.stretch_y, sampling.reach_y(), weights);
    }

    // The weights, of sum 1, of the pixels from the returned one on.
    int weigh(double centre, double stretch, double reach, std::span<double> weights) const {
        const int first = static_cast<int>(std::floor(centre - reach));
        double sum = 0;
        for (std::size_t i = 0; i < weights.size(); ++i) {
            weights[i] = filter_weight(sampling.filter, (first + static_cast<int>(i) - centre) / stretch);
            sum += weights[i];
        }
        for (double& w : weights) w /= sum;
        return first;
    }
};

struct Transform {
    static constexpr Info info{"transform", "Moves, turns and scales an image; the display window stays."};

    struct Params {
        Input in;
        Vec2 translate = 0, scale = 1;
        double rotate = 0;
        std::optional<std::array<double, 2>> center;
        Filter filter = Filter::kCubic;

        static constexpr auto fields = declare(
            input(&Params::in, "in", "The image; each channel by itself."),
            field(&Params::translate, "translate", "How far it is moved, right and down; last.",
                  px(-1e6, 1e6).tested_to(20)),
            field(&Params::rotate, "rotate", "How far it is turned, counter-clockwise; after scale.",
                  between(-3600, 3600, "degrees")),
            field(&Params::scale, "scale", "How much larger it becomes, or [x, y].",
                  between(0.01, 1000).tested_to(4)),
            field(&Params::center, "center",
                  "The point that scale and rotate leave in place; absent: the centre of the display window.",
                  px(-1e6, 1e6)),
            field(&Params::filter, "filter", "What the image is resampled with."));
    };

    explicit Transform(const Params& p) : params(p) {}

    Stream expand(Builder& builder) const {
        const Stream in = builder.input(params.in);
        if (params.translate == Vec2(0) && params.scale == Vec2(1) && params.rotate == 0) return in;
        Stream out = in;
        out.metadata = restretched(in.metadata);
        const Point c = centre(in.display);
        const Sampling sampling(to_in(c), params.filter);
        out.window = in.window.empty()
                         ? in.window
                         : bounds(in.window, sampling.reach_x() - 0.5, sampling.reach_y() - 0.5, to_out(c));
        refuse_unreachable(out.window);
        if (params.filter != Filter::kNearest && !moves_by_whole_pixels())
            tell_of_ids(builder, in, "each pixel takes the nearest");
        const auto resampled = make_operation(std::make_shared<const Resampled>(Resampled{sampling})),
                   exact = make_operation(std::make_shared<const Resampled>(
                       Resampled{Sampling(to_in(c), Filter::kNearest), true}));
        for (StreamChannel& channel : out.channels)
            channel.value = builder
                                .add(channel.exact() ? exact : resampled,
                                     {{in.window, in.window, {channel.value}}}, out.window, 1)
                                .front();
        return out;
    }

    const Params params;

private:
    bool moves_by_whole_pixels() const {
        const Vec2& t = params.translate;
        return params.scale == Vec2(1) && params.rotate == 0 && std::floor(t.x) == t.x &&
               std::floor(t.y) == t.y;
    }

    // Pixels that were not square are made squarer, or less so.  Square ones stay: what is stretched is the
    // drawing.
    std::shared_ptr<const Metadata> restretched(const std::shared_ptr<const Metadata>& metadata) const {
        const Vec2 s = params.scale;
        const float aspect = pixel_aspect(*metadata);
        if (aspect == 1 || s.x == s.y || std::fmod(params.rotate, 180) != 0) return metadata;
        Metadata out = *metadata;
        set_pixel_aspect(out, double{aspect} * s.y / s.x);
        return std::make_shared<const Metadata>(std::move(out));
    }

    Point centre(const Rect& display) const {
        if (params.center) return {(*params.center)[0], (*params.center)[1]};
        return {(double(display.x0) + display.x1) / 2, (double(display.y0) + display.y1) / 2};
    }

    // p → R S (p − c) + c + t, with y down: turned counter-clockwise as it is seen.
    Affine to_out(Point c) const {
        const auto [sin, cos] = elementary::sin_cos_degrees(params.rotate);
        const Vec2 s = params.scale, t = params.translate;
        const Affine linear{cos * s.x, sin * s.y, -sin * s.x, cos * s.y, 0, 0};
        return around(linear, c, {c.x + t.x, c.y + t.y});
    }

    Affine to_in(Point c) const {
        const auto [sin, cos] = elementary::sin_cos_degrees(params.rotate);
        const Vec2 s = params.scale, t = params.translate;
        const Affine linear{cos / s.x, -sin / s.x, sin / s.y, cos / s.y, 0, 0};
        return around(linear, {c.x + t.x, c.y + t.y}, c);
    }

    // The map with this linear part that takes one point to another.
    static Affine around(Affine linear, Point from, Point to) {
        const Point moved = linear(from);
        linear.x0 = to.x - moved.x;
        linear.y0 = to.y - moved.y;
        return linear;
    }
};

}  // namespace

KEYLINE_NODE(transform, Transform)

}  // namespace keyline
