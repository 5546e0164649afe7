// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/noise.h"
#include "engine/kit/stroke_anchors.h"
#include "engine/kit/stroke_way.h"
#include "engine/kit/strokes.h"
#include "engine/kit/surface_places.h"
#include "engine/node/node_adaptor.h"
#include "engine/simd/elementary.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace keyline {

namespace {

enum class Anchor { kAuto, kSurface, kScreen, kStroke };

constexpr auto words(Anchor) {
    return std::array{
        Word<Anchor>{"auto", Anchor::kAuto, "the surface where strokes have anchors on it, else the stroke"},
        Word<Anchor>{"surface", Anchor::kSurface, "the anchors: it stays on the surface as that moves"},
        Word<Anchor>{"stroke", Anchor::kStroke, "the length along the stroke"},
        Word<Anchor>{"screen", Anchor::kScreen, "the place in the picture: strokes move through it"}};
}

struct WobbleParams {
    Input in;
    std::optional<Input> surface;
    double amount = 0.6, scale = 24;
    int hold = 2;
    Anchor anchor = Anchor::kAuto;
    std::optional<double> surface_scale;
    int octaves = 2;
    double breathe = 0.1;
    int seed = 0;

    static constexpr auto fields = declare(
        input(&WobbleParams::in, "in", "The strokes.", data<Strokes>()),
        input(&WobbleParams::surface, "surface",
              "U V or S T, or the place at rest or in the world, X Y Z, looked up beside the line on what it "
              "belongs to: waves stay with the surface as that moves. Without it they do so for strokes that "
              "have anchors, which only files tell."),
        field(&WobbleParams::amount, "amount", "How far, in pixels of a display window 1080 high.",
              between(0, 100)),
        field(&WobbleParams::scale, "scale", "How long a wave is, in the same pixels.", between(1, 10000)),
        field(&WobbleParams::hold, "hold", "How many frames share a drawing: 2 is on twos. 0: all do.",
              between(0, 1000)),
        field(&WobbleParams::anchor, "anchor", "What the waves stay with."),
        field(&WobbleParams::surface_scale, "surface_scale",
              "How long a wave is on the surface, in the units of the anchors; when absent 'scale' says it, "
              "and "
              "waves are as long in the picture wherever the surface goes.",
              at_least(1e-6).tested_to(4)),
        field(&WobbleParams::octaves, "octaves", "Each is half as long and half as high as the one before.",
              between(1, 8)),
        field(&WobbleParams::breathe, "breathe", "How much the width swells and shrinks, as a share of it.",
              between(0, 1)),
        field(&WobbleParams::seed, "seed", "Another hand.", between(0, 100000)));
};

// Where in the noise a vertex lies, in waves.
struct Place {
    double x = 0, y = 0, z = 0;

    friend Place operator/(const Place& p, double wave) { return {p.x / wave, p.y / wave, p.z / wave}; }
};

Place place_of_anchor(const StrokeVertex& v) { return {v.anchor[0], v.anchor[1], v.anchor[2]}; }

// How much of the surface a pixel of the stroke is, in most places: seams and what lies before the surface
// make a few steps long.  0 where it is not known.
double surface_in_a_pixel(const Stroke& s) {
    std::vector<double> steps;
    for (std::size_t i = 1; i < s.vertices.size(); ++i) {
        const StrokeVertex &a = s.vertices[i - 1], &b = s.vertices[i];
        double square = 0;
        for (std::size_t k = 0; k < 3; ++k)
            square += (b.anchor[k] - a.anchor[k]) * (b.anchor[k] - a.anchor[k]);
        if (b.arc > a.arc) steps.push_back(std::sqrt(square) / (b.arc - a.arc));
    }
    if (steps.empty()) return 0;
    const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
    std::ranges::nth_element(steps, middle);
    return std::isfinite(*middle) ? *middle : 0;
}

// Waves on a surface that are as long in the picture, however near that is: of the two lengths that are
// powers of two around the wanted one, each counts as near as it is, so that waves don't run over the surface
// when it comes nearer.
struct SurfaceWaves {
    double lower = 1;   // the shorter of both, in the units of the surface; the other is twice as long
    double longer = 0;  // the share of the other

    explicit SurfaceWaves(double wanted) {
        int exponent = 0;
        const double mantissa = std::frexp(wanted, &exponent);  // ½ to 1
        lower = std::ldexp(1.0, exponent - 1);
        longer = 2 * mantissa - 1;
    }
};

struct Shake {
    struct Params {
        Input strokes;
        static constexpr auto fields = declare(input(&Params::strokes, "strokes", "", data<Strokes>()));
    };

    Shake(WobbleParams p, int drawn) : params(std::move(p)), drawing(drawn) {}

    Strokes derive(const Inputs& in) const {
        Strokes out = in.datum<Strokes>(0);
        const double unit = display_unit(out);
        for (Stroke& s : out.strokes) move(s, unit);
        arrange(out);
        return out;
    }
    static std::size_t datum_bytes() { return kUsualStrokes; }

    const WobbleParams params;
    const int drawing;  // the same for frames that are held

private:
    enum Component { kAside, kBreath };

    // −1 to 1 for each vertex.
    std::vector<double> waves_of(const Stroke& s, double unit, Component which) const {
        const double wave = params.scale * unit;
        std::vector<double> out;
        if (params.anchor == Anchor::kScreen) {
            for (const StrokeVertex& v : s.vertices)
                out.push_back(noise_at({v.x / wave, v.y / wave, 0}, which));
        } else if (s.anchor != StrokeAnchor::kNone && params.anchor != Anchor::kStroke) {
            return on_surface(s, wave, which);
        } else {
            for (const StrokeVertex& v : s.vertices) out.push_back(noise_at(along(s, v, wave), which));
        }
        return out;
    }

    std::vector<double> on_surface(const Stroke& s, double wave, Component which) const {
        std::vector<double> out;
        if (params.surface_scale) {
            for (const StrokeVertex& v : s.vertices)
                out.push_back(noise_at(place_of_anchor(v) / *params.surface_scale, which));
        } else if (const double wanted = wave * surface_in_a_pixel(s); wanted > 0) {
            const SurfaceWaves waves(wanted);
            for (const StrokeVertex& v : s.vertices) {
                const Place at = place_of_anchor(v) / waves.lower;
                out.push_back((1 - waves.longer) * noise_at(at, which) +
                              waves.longer * noise_at(at / 2, which));
            }
        } else {
            out.assign(s.vertices.size(), 0);
        }
        return without_jumps(out, s.closed, wave);
    }

    // At a seam, and where something before the surface is hit, its places jump, and the hand must not.
    static std::vector<double> without_jumps(const std::vector<double>& values, bool closed, double wave) {
        constexpr double kOfWave = 0.125;
        const auto reach = static_cast<std::ptrdiff_t>(std::min(kOfWave * wave, 1000.0));
        std::vector<double> out;
        for (std::size_t i = 0; i < values.size(); ++i)
            out.push_back(mean_along(values, closed, i, reach, true));
        return out;
    }

    // A closed stroke's waves fit its length: the noise repeats after 256.
    static Place along(const Stroke& s, const StrokeVertex& v, double wave) {
        const double hash = (s.near % 251) * 7 + static_cast<double>(s.kind) * 3;
        if (!s.closed) return {v.arc / wave, hash, 0};
        const double waves = std::max(1.0, std::floor(length_of(s) / wave + 0.5));
        const auto turn = elementary::sin_cos_degrees(360 * v.u);
        constexpr double kTurn = 6.283185307179586;
        return {waves / kTurn * turn.cos, hash + waves / kTurn * turn.sin, 0};
    }

    // −1 to 1, the same for the same place and drawing.
    double noise_at(const Place& p, Component which) const {
        // Each drawing, hand and component has a place of its own, off the lattice where the noise is 0.
        const double away = 0.5 + 17.31 * drawing + 5.77 * params.seed + 91.13 * static_cast<int>(which);
        double sum = 0, all = 0, high = 1, fine = 1;
        for (int i = 0; i < params.octaves; ++i) {
            sum += high * noise::signed_value(fine * p.x + away, fine * p.y + 0.37 * away, fine * p.z);
            all += high;
            high /= 2;
            fine *= 2;
        }
        return sum / all;
    }

    void move(Stroke& s, double unit) const {
        const std::vector<double> asides = waves_of(s, unit, kAside), breaths = waves_of(s, unit, kBreath);
        const std::vector<StrokeVertex> before = s.vertices;
        for (std::size_t i = 0; i < before.size(); ++i) {
            const StrokeWay way = way_at(before, s.closed, i);
            StrokeVertex& v = s.vertices[i];
            v.width *= 1 + params.breathe * breaths[i];
            if (!(way.length > 0)) continue;
            const double aside = params.amount * unit * asides[i];
            v.x -= aside * way.y / way.length;
            v.y += aside * way.x / way.length;
        }
    }
};

// A hand that is not quite sure, and draws again every few frames.
struct Wobble {
    static constexpr Info info{"wobble",
                               "Moves strokes aside a little, as a hand does, anew every few frames."};
    using Gives = Strokes;
    using Params = WobbleParams;

    static void check(const Params& p, Check& c) {
        if (p.surface && (p.anchor == Anchor::kStroke || p.anchor == Anchor::kScreen))
            c.error("surface", "'anchor' says that waves don't stay with a surface", "leave out one of both");
    }

    Wobble(Params p, Context& context) : params(std::move(p)), drawing(held(params.hold, context.frame())) {}

    Stream expand(Builder& builder) const {
        Stream in = builder.input(params.in);
        if (params.amount == 0 && params.breathe == 0) return in;
        if (params.surface)
            in = with_anchors(builder, in, surface_places(builder, *params.surface, "surface"));
        return add_operation(builder, Shake(params, drawing), {in});
    }

    const Params params;
    const int drawing;

private:
    static int held(int hold, int frame) { return hold == 0 ? 0 : floor_div(frame, hold); }
};

}  // namespace

KEYLINE_NODE(wobble, Wobble)

}  // namespace keyline
