// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/node_adaptor.h"
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
                  "U V to hang the strokes on, or a position X Y Z, of which X and Y + Z count."));
    };
    static constexpr std::array outputs{"matte"};

    static void check(const Params& p, Check& c) {
        if (p.angles.empty()) c.error("angles", "'angles' is empty", "give one angle at least");
    }

    explicit Hatch(const Params& p)
        : in(p.in), coords(p.coords), spacing(p.spacing), width(std::min(p.width, p.spacing)) {
        for (const double angle : p.angles) directions.push_back(elementary::sin_cos_degrees(angle));
    }

    Halo halo() const { return coords ? Halo{1, 1} : Halo{}; }
    double cost() const { return 40.0 * static_cast<double>(directions.size()); }

    void compute(const Inputs& inputs, Outputs out, Scratch&) const {
        const std::span<const View> places = inputs[coords];
        const Rect& rect = out[0].rect;
        for (int y = rect.y0; y < rect.y1; ++y)
            for (int x = rect.x0; x < rect.x1; ++x)
                *out[0].at(x, y) = static_cast<float>(inked(double{*inputs[in][0].at(x, y)}, places, x, y));
    }

    const Input in;
    const std::optional<Input> coords;
    const double spacing, width;
    std::vector<elementary::SinCos> directions;

private:
    double inked(double tone, std::span<const View> places, int x, int y) const {
        const double darkness = (1 - tone) * static_cast<double>(directions.size());
        double paper = 1;
        for (std::size_t i = 0; i < directions.size(); ++i) {
            const double band = std::clamp(darkness - static_cast<double>(i), 0.0, 1.0);
            if (!(band > 0)) break;  // NaN has no strokes
            const Across across =
                places.empty() ? on_screen(directions[i], x, y) : on_surface(directions[i], places, x, y);
            const Strokes strokes{spacing, band * width};
            const double cover = strokes.cover(across.at, std::abs(across.dx) + std::abs(across.dy));
            paper *= 1 - (cover == cover ? cover : 0);
        }
        return 1 - paper;
    }

    static Across on_screen(const elementary::SinCos& d, int x, int y) {
        return {(x + 0.5) * d.sin + (y + 0.5) * d.cos, d.sin, d.cos};
    }

    static Across on_surface(const elementary::SinCos& d, std::span<const View> places, int x, int y) {
        const Rect& rect = places[0].rect;
        const auto at = [&](int px, int py) {
            if (!rect.contains(px, py)) return 0.0;
            double v = places.size() > 1 ? double{*places[1].at(px, py)} : 0.0;
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

}  // namespace

KEYLINE_NODE(hatch, Hatch)

}  // namespace keyline
