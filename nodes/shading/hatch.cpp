// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/surface_places.h"
#include "engine/node/node_adaptor.h"
#include "engine/simd/elementary.h"

#include <algorithm>
#include <cmath>

namespace keyline {

namespace {

// Parallel strokes at all multiples of a spacing, as wide as `width`, along an axis across them.
struct Strokes {
    double spacing, width;

    // How much of the axis from 0 to `at` is stroke.
    double up_to(double at) const {
        const double stroke = std::floor(at / spacing + 0.5);
        return stroke * width + std::clamp(at - stroke * spacing, -width / 2, width / 2);
    }

    // How much of the `length` around `at` is stroke: 0 … 1.
    double cover(double at, double length) const {
        if (!(length > 0))
            return std::abs(at - std::floor(at / spacing + 0.5) * spacing) <= width / 2 ? 1.0 : 0.0;
        return std::clamp((up_to(at + length / 2) - up_to(at - length / 2)) / length, 0.0, 1.0);
    }
};

// A place across strokes, and how far it is from one pixel to the next in x and in y.
struct Across {
    double at, dx, dy;
};

// The smaller step of the two to the neighbours: at an outline one of them leads to another surface.
double slope(double before, double here, double after) {
    const double a = here - before, b = after - here;
    return std::abs(a) < std::abs(b) ? a : b;
}

// How dark a tone is inked, by the strokes of one direction after the other.
struct Pen {
    double spacing, width;
    std::vector<elementary::SinCos> directions;

    double cost() const { return 40.0 * static_cast<double>(directions.size()); }

    // `across` tells where a pixel lies across a direction's strokes.
    template <class F>
    float inked(double tone, const F& across_of) const {
        const double darkness = (1 - tone) * static_cast<double>(directions.size());
        double paper = 1;
        for (std::size_t i = 0; i < directions.size(); ++i) {
            const double band = std::clamp(darkness - static_cast<double>(i), 0.0, 1.0);
            if (!(band > 0)) break;  // NaN has no strokes
            const Across across = across_of(directions[i]);
            const Strokes strokes{spacing, band * width};
            const double cover = strokes.cover(across.at, std::abs(across.dx) + std::abs(across.dy));
            paper *= 1 - (cover == cover ? cover : 0);
        }
        return static_cast<float>(1 - paper);
    }
};

struct HatchOnScreen {
    struct Params {
        Input in;
        static constexpr auto fields = declare(input(&Params::in, "in", "", matte()));
    };
    static constexpr std::array outputs{"matte"};

    double cost() const { return pen.cost(); }
    // A tone of 0 is dark: where no stroke crosses one pixel another is crossed.
    static Rect window(const std::vector<Port>& ports) { return ports[0].stream.extent(); }

    void compute(const Inputs& inputs, Outputs out, Scratch&) const {
        const View& tone = inputs.slot(0)[0];
        const Rect& rect = out[0].rect;
        for (int y = rect.y0; y < rect.y1; ++y)
            for (int x = rect.x0; x < rect.x1; ++x)
                *out[0].at(x, y) = pen.inked(double{*tone.at(x, y)}, [&](const elementary::SinCos& d) {
                    return Across{(x + 0.5) * d.sin + (y + 0.5) * d.cos, d.sin, d.cos};
                });
    }

    Pen pen;
};

// On coordinates of two channels, or of three, of which the last two are added.
struct HatchOnSurface {
    struct Params {
        Input in, coords;
        static constexpr auto fields =
            declare(input(&Params::in, "in", "", matte()), input(&Params::coords, "coords", ""));
    };
    static constexpr std::array outputs{"matte"};

    Halo halo() const { return {1, 1}; }
    double cost() const { return 3 * pen.cost(); }

    void compute(const Inputs& inputs, Outputs out, Scratch&) const {
        const View& tone = inputs.slot(0)[0];
        const std::span<const View> places = inputs.slot(1);
        const Rect& rect = out[0].rect;
        for (int y = rect.y0; y < rect.y1; ++y)
            for (int x = rect.x0; x < rect.x1; ++x)
                *out[0].at(x, y) = pen.inked(double{*tone.at(x, y)}, [&](const elementary::SinCos& d) {
                    return across(d, places, x, y);
                });
    }

    Pen pen;

private:
    static Across across(const elementary::SinCos& d, std::span<const View> places, int x, int y) {
        const Rect& rect = places[0].rect;
        const auto at = [&](int px, int py) {
            if (!rect.contains(px, py)) return 0.0;
            double v = double{*places[1].at(px, py)};
            if (places.size() > 2) v += double{*places[2].at(px, py)};
            return -d.sin * double{*places[0].at(px, py)} + d.cos * v;
        };
        const double here = at(x, y);
        const auto step = [&](int dx, int dy) {
            const bool before = rect.contains(x - dx, y - dy), after = rect.contains(x + dx, y + dy);
            if (before && after) return slope(at(x - dx, y - dy), here, at(x + dx, y + dy));
            return after ? at(x + dx, y + dy) - here : before ? here - at(x - dx, y - dy) : 0.0;
        };
        return {here, step(1, 0), step(0, 1)};
    }
};

struct Hatch {
    static constexpr Info info{"hatch",
                               "Strokes that widen where a tone darkens, more directions the darker."};

    struct Params {
        Input in;
        std::vector<double> angles{45, -45};
        double spacing = 8, width = 4;
        std::optional<Input> coords;

        static constexpr auto fields = declare(
            input(&Params::in, "in", "The tone: 1 is light, without strokes, 0 dark, with all.", matte()),
            field(&Params::angles, "angles",
                  "The direction of the strokes of each band of tone, the lightest first; degrees, "
                  "counter-clockwise from horizontal.",
                  between(-360, 360, "degrees")),
            field(&Params::spacing, "spacing", "From stroke to stroke; pixels, or units of coords.",
                  between(1e-6, 1e6).tested_to(32)),
            field(&Params::width, "width",
                  "Of a stroke where its band is darkest, in the same units; from the spacing on strokes "
                  "cover everything.",
                  between(0, 1e6).tested_to(32)),
            input(&Params::coords, "coords",
                  "U V or S T to hang the strokes on, or a position X Y Z, of which X and Y + Z count."));
    };
    static constexpr std::array outputs{"matte"};

    static void check(const Params& p, Check& c) {
        if (p.angles.empty()) c.error("angles", "'angles' is empty", "give one angle at least");
    }

    explicit Hatch(Params p) : params(std::move(p)) {}

    Stream expand(Builder& builder) const {
        Pen pen{params.spacing, std::min(params.width, params.spacing), {}};
        for (const double angle : params.angles) pen.directions.push_back(elementary::sin_cos_degrees(angle));
        const Stream tone = builder.input(params.in);
        if (!params.coords) return add_operation(builder, HatchOnScreen{std::move(pen)}, {tone});
        return add_operation(builder, HatchOnSurface{std::move(pen)},
                             {tone, surface_places(builder, *params.coords, "coords")});
    }

    const Params params;
};

}  // namespace

KEYLINE_NODE(hatch, Hatch)

}  // namespace keyline
