// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/noise.h"
#include "engine/kit/stroke_way.h"
#include "engine/kit/strokes.h"
#include "engine/node/node_adaptor.h"
#include "engine/simd/elementary.h"

#include <cmath>

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

// A hand that is not quite sure, and draws again every few frames.
struct Wobble {
    static constexpr Info info{"wobble",
                               "Moves strokes aside a little, as a hand does, anew every few frames."};

    struct Params {
        Input in;
        double amount = 0.6, scale = 24;
        int hold = 2;
        Anchor anchor = Anchor::kAuto;
        double surface_scale = 0.1;
        int octaves = 2;
        double breathe = 0.1;
        int seed = 0;

        static constexpr auto fields = declare(
            input(&Params::in, "in", "The strokes.", data<Strokes>()),
            field(&Params::amount, "amount", "How far, in pixels of a display window 1080 high.",
                  between(0, 100)),
            field(&Params::scale, "scale", "How long a wave is, in the same pixels.", between(1, 10000)),
            field(&Params::hold, "hold", "How many frames share a drawing: 2 is on twos. 0: all do.",
                  between(0, 1000)),
            field(&Params::anchor, "anchor", "What the waves stay with."),
            field(&Params::surface_scale, "surface_scale",
                  "How long a wave is on the surface, in the units of the anchors.",
                  at_least(1e-6).tested_to(4)),
            field(&Params::octaves, "octaves", "Each is half as long and half as high as the one before.",
                  between(1, 8)),
            field(&Params::breathe, "breathe", "How much the width swells and shrinks, as a share of it.",
                  between(0, 1)),
            field(&Params::seed, "seed", "Another hand.", between(0, 100000)));
    };

    Wobble(Params p, Context& context) : params(std::move(p)), drawing(held(params.hold, context.frame())) {}

    bool identity() const { return params.amount == 0 && params.breathe == 0; }

    Strokes derive(const Inputs& in) const {
        Strokes out = in.datum<Strokes>(params.in);
        const double unit = display_unit(out);
        for (Stroke& s : out.strokes) move(s, unit);
        arrange(out);
        return out;
    }
    static std::size_t datum_bytes() { return kUsualStrokes; }

    const Params params;
    const int drawing;  // the same for frames that are held

private:
    struct Place {
        double x = 0, y = 0, z = 0;
    };

    static int held(int hold, int frame) { return hold == 0 ? 0 : floor_div(frame, hold); }

    // Where in the noise a vertex lies, in waves.
    Place place_of(const Stroke& s, const StrokeVertex& v, double unit) const {
        const double wave = params.scale * unit;
        const bool has_anchor = s.anchor != StrokeAnchor::kNone;
        if (params.anchor == Anchor::kScreen) return {v.x / wave, v.y / wave, 0};
        if (has_anchor && params.anchor != Anchor::kStroke)
            return {v.anchor[0] / params.surface_scale, v.anchor[1] / params.surface_scale,
                    v.anchor[2] / params.surface_scale};
        return along(s, v, wave);
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
    double noise_at(const Place& p, int which) const {
        // Each drawing, hand and component has a place of its own, off the lattice where the noise is 0.
        const double away = 0.5 + 17.31 * drawing + 5.77 * params.seed + 91.13 * which;
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
        const std::vector<StrokeVertex> before = s.vertices;
        for (std::size_t i = 0; i < before.size(); ++i) {
            const StrokeWay way = way_at(before, s.closed, i);
            const Place place = place_of(s, before[i], unit);
            StrokeVertex& v = s.vertices[i];
            v.width *= 1 + params.breathe * noise_at(place, 1);
            if (!(way.length > 0)) continue;
            const double aside = params.amount * unit * noise_at(place, 0);
            v.x -= aside * way.y / way.length;
            v.y += aside * way.x / way.length;
        }
    }
};

}  // namespace

KEYLINE_NODE(wobble, Wobble)

}  // namespace keyline
