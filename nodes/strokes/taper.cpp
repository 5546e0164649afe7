// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/strokes.h"
#include "engine/node/node_adaptor.h"
#include "engine/simd/elementary.h"

#include <algorithm>
#include <cmath>

namespace keyline {

namespace {

enum class Units { kDisplay, kPixels, kShare };

constexpr auto words(Units) {
    return std::array{
        Word<Units>{"display", Units::kDisplay, "pixels of a display window 1080 high: the same at any size"},
        Word<Units>{"px", Units::kPixels, "pixels of the frame"},
        Word<Units>{"share", Units::kShare, "shares of the stroke's length"}};
}

enum class Shape { kEllipse, kLinear, kPower };

constexpr auto words(Shape) {
    return std::array{Word<Shape>{"ellipse", Shape::kEllipse, "rounded, as a brush lifts"},
                      Word<Shape>{"linear", Shape::kLinear, "straight to a point"},
                      Word<Shape>{"power", Shape::kPower, "by 'power': a long thin tip above 1"}};
}

struct Taper {
    static constexpr Info info{"taper", "Strokes that grow from nothing and end in a tip."};

    struct Params {
        Input in;
        double start = 20, end = 40;
        Units units = Units::kDisplay;
        Shape shape = Shape::kEllipse;
        double power = 2;
        std::vector<StrokeEnd> at{StrokeEnd::kEnd, StrokeEnd::kOccluded};
        double overshoot = 0;

        static constexpr auto fields = declare(
            input(&Params::in, "in", "The strokes.", data<Strokes>()),
            field(&Params::start, "start", "The length of the tip at a stroke's first point.",
                  at_least(0).tested_to(60)),
            field(&Params::end, "end", "The length of the tip at its last.", at_least(0).tested_to(60)),
            field(&Params::units, "units", "What lengths are measured in."),
            field(&Params::shape, "shape", "How the width falls."),
            field(&Params::power, "power", "For the shape of that name.", between(0.1, 8)),
            field(&Params::at, "at", "Which ends have tips."),
            field(&Params::overshoot, "overshoot", "How far strokes go on straight beyond such an end.",
                  at_least(0).tested_to(20)));
    };

    explicit Taper(Params p) : params(std::move(p)) {}

    Strokes derive(const Inputs& in) const {
        Strokes out = in.datum<Strokes>(params.in);
        for (Stroke& s : out.strokes)
            if (!s.closed) taper(s, display_unit(out));
        if (params.overshoot > 0) arrange(out);
        return out;
    }
    static std::size_t datum_bytes() { return kUsualStrokes; }

    const Params params;

private:
    bool has_tip(StrokeEnd end) const { return std::ranges::find(params.at, end) != params.at.end(); }

    void taper(Stroke& s, double display) const {
        const double unit = params.units == Units::kDisplay  ? display
                            : params.units == Units::kPixels ? 1
                                                             : length_of(s);
        if (has_tip(s.ends[1])) overshoot(s, unit);
        std::ranges::reverse(s.vertices);
        if (has_tip(s.ends[0])) overshoot(s, unit);
        std::ranges::reverse(s.vertices);
        measure(s);
        const double length = s.vertices.back().arc;
        double start = has_tip(s.ends[0]) ? params.start * unit : 0,
               end = has_tip(s.ends[1]) ? params.end * unit : 0;
        // Both tips share a stroke that is too short for them.
        const double share = start + end > length ? length / (start + end) : 1;
        start *= share;
        end *= share;
        for (StrokeVertex& v : s.vertices) v.width *= at(v.arc, start) * at(length - v.arc, end);
    }

    // Goes on as the last few pixels ran.
    void overshoot(Stroke& s, double unit) const {
        if (!(params.overshoot > 0)) return;
        constexpr double kReach = 3;
        const StrokeVertex last = s.vertices.back();
        std::size_t from = s.vertices.size() - 1;
        const auto away = [&](std::size_t i) {
            const double x = last.x - s.vertices[i].x, y = last.y - s.vertices[i].y;
            return std::sqrt(x * x + y * y);
        };
        while (from > 0 && away(from) < kReach) --from;
        const double run = away(from), length = params.overshoot * unit;
        if (!(run > 0)) return;
        StrokeVertex v = last;
        v.x += (last.x - s.vertices[from].x) / run * length;
        v.y += (last.y - s.vertices[from].y) / run * length;
        s.vertices.push_back(v);
    }

    // The share of the width at a distance from an end whose tip is so long.
    double at(double distance, double tip) const {
        if (!(distance < tip)) return 1;
        const double t = std::max(0.0, distance / tip);
        switch (params.shape) {
            case Shape::kEllipse: return std::sqrt(1 - (1 - t) * (1 - t));
            case Shape::kLinear: return t;
            case Shape::kPower: break;
        }
        return elementary::pow(t, params.power);
    }
};

}  // namespace

KEYLINE_NODE(taper, Taper)

}  // namespace keyline
