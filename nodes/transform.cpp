// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/filter.h"
#include "engine/node_adaptor.h"
#include "engine/pixel_loop.h"
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

    double reach_x() const { return filter_radius(filter) * stretch_x; }
    double reach_y() const { return filter_radius(filter) * stretch_y; }
};

// The pixels that the corners of a rectangle, grown by rx and ry, are mapped on.
Rect bounds(const Rect& r, double rx, double ry, const Affine& map) {
    const Point corners[] = {map({r.x0 - rx, r.y0 - ry}), map({r.x1 + rx, r.y0 - ry}),
                             map({r.x0 - rx, r.y1 + ry}), map({r.x1 + rx, r.y1 + ry})};
    const auto [x0, x1] = std::ranges::minmax(corners, {}, &Point::x);
    const auto [y0, y1] = std::ranges::minmax(corners, {}, &Point::y);
    const auto pixel = [](double v) {
        return static_cast<int>(std::clamp(v, -double(kMaxCoordinate), double(kMaxCoordinate)));
    };
    return {pixel(std::floor(x0.x)), pixel(std::floor(y0.y)), pixel(std::ceil(x1.x)), pixel(std::ceil(y1.y))};
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
        const auto wx = scratch.take<double>(taps(sampling.reach_x())),
                   wy = scratch.take<double>(taps(sampling.reach_y()));
        for (int y = out.rect.y0; y < out.rect.y1; ++y)
            for (int x = out.rect.x0; x < out.rect.x1; ++x)
                *out.at(x, y) = with_one_nan(sample(in, sampling.to_in({x + 0.5, y + 0.5}), wx, wy));
    }

    Sampling sampling;

private:
    static std::size_t taps(double reach) { return static_cast<std::size_t>(2 * std::ceil(reach)) + 2; }

    float sample(const View& in, Point at, std::span<double> wx, std::span<double> wy) const {
        const int x0 = weigh(at.x - 0.5, sampling.stretch_x, sampling.reach_x(), wx);
        const int y0 = weigh(at.y - 0.5, sampling.stretch_y, sampling.reach_y(), wy);
        const int left = std::max(x0, in.rect.x0),
                  right = std::min(x0 + static_cast<int>(wx.size()), in.rect.x1);
        const int top = std::max(y0, in.rect.y0),
                  bottom = std::min(y0 + static_cast<int>(wy.size()), in.rect.y1);
        double sum = 0;
        for (int y = top; y < bottom; ++y)
            for (int x = left; x < right; ++x) {
                const double w = wx[static_cast<std::size_t>(x - x0)] * wy[static_cast<std::size_t>(y - y0)];
                // A weight of 0 takes nothing, not even NaN or infinity.
                if (w != 0) sum += w * double{*in.at(x, y)};
            }
        return static_cast<float>(sum);
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
        const Point c = centre(in.display);
        const Sampling sampling(to_in(c), params.filter);
        out.window = in.window.empty()
                         ? in.window
                         : bounds(in.window, sampling.reach_x() - 0.5, sampling.reach_y() - 0.5, to_out(c));
        const auto operation = make_operation(std::make_shared<const Resampled>(Resampled{sampling}));
        for (StreamChannel& channel : out.channels)
            channel.value = builder.add(operation, {{in.window, {channel.value}}}, out.window, 1).front();
        return out;
    }

    const Params params;

private:
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
