// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/noise.h"
#include "engine/kit/uv_map.h"

namespace keyline {

namespace {

// ∫ smoothstep(low, high) from 0 to x, for 0 ≤ low.
double smooth_step_up_to(double low, double high, double x) {
    if (x <= low) return 0;
    const double length = high - low;
    if (x >= high) return length / 2 + (x - high);
    const double t = (x - low) / length;
    return length * t * t * t * (1 - t / 2);
}

// How light the wood is from ring to ring, which are 1 apart.  It rises slowly and falls at once.
struct Rings {
    static double at(double r) {
        r -= std::floor(r);
        return 0.5 + 0.5 * smooth_step(0.2, 0.55, r) * (1 - smooth_step(0.75, 0.8, r));
    }
    static double up_to(double r) {
        const double whole = std::floor(r), rest = r - whole;
        return whole * mean() + within(rest);
    }
    static double mean() { return within(1); }
    static double mean(const Extent& e) {
        return e.is_point() ? at(e.at) : (up_to(e.to()) - up_to(e.from())) / e.size;
    }

private:
    // The fall begins above the rise's end, so their product is a difference.
    static double within(double r) {
        return 0.5 * (r + smooth_step_up_to(0.2, 0.55, r) - smooth_step_up_to(0.75, 0.8, r));
    }
};

// What a pixel sees, along and across the planks of a tile.
struct GrainPlace {
    Extent across, along;
    UvStep right, down;  // to the next pixels; u is across
};

// A floor of square tiles of side 1.  Each has planks side by side, which lie one way in one tile and the
// other way in the next.
struct Wood {
    static constexpr Info info{"wood", "A parquet of planks with growth rings, on surface coordinates."};

    struct Params {
        Input uv;
        double plankwidth = 0.2, spacewidth = 0.02, texturescale = 8, ringfactor = 25, wavefactor = 0.8,
               colorvariation = 0.5;
        Color woodcolor{0.57, 0.292, 0.125}, ringcolor{0.275, 0.15, 0.06}, spacecolor;

        static constexpr auto fields = declare(
            input(&Params::uv, "uv",
                  "U V, or S T.  Where there is an A they are premultiplied by it, and the floor is as "
                  "transparent as it says."),
            field(&Params::plankwidth, "plankwidth",
                  "Of a plank's length; planks fill a square tile side by side, the last is narrower where "
                  "it must.",
                  between(0.01, 1)),
            field(&Params::spacewidth, "spacewidth", "Of the gaps, in lengths of a plank.", between(0, 1)),
            field(&Params::texturescale, "texturescale", "How many planks a surface unit is long.",
                  between(1e-6, 1e6).tested_to(16)),
            field(&Params::ringfactor, "ringfactor", "How many growth rings there are.",
                  at_least(0).tested_to(50)),
            field(&Params::wavefactor, "wavefactor", "How wavy they are.", at_least(0).tested_to(4)),
            field(&Params::colorvariation, "colorvariation", "How much planks differ in brightness.",
                  at_least(0).tested_to(1)),
            field(&Params::woodcolor, "woodcolor", "Between the rings."),
            field(&Params::ringcolor, "ringcolor", "Of the rings; they take half of it at most."),
            field(&Params::spacecolor, "spacecolor", "Of the gaps."));
    };
    static constexpr std::array outputs{"R", "G", "B", "A"};

    explicit Wood(const Params& p) : params(p), planks(std::ceil(1 / p.plankwidth - 1e-9)) {}

    Stream expand(Builder& builder) const {
        return add_pattern(builder, params.uv, 900,
                           [floor = *this](const UvPlace& place) { return floor.color(place); });
    }

    const Params params;
    const double planks;  // in a tile

private:
    struct Sum {
        double covered = 0;
        PatternColor color{};

        void add(double share, const PatternColor& c) {
            covered += share;
            for (std::size_t i = 0; i < 3; ++i) color[i] += share * c[i];
        }
    };

    PatternColor color(const UvPlace& place) const {
        const double scale = params.texturescale;
        const UvStep right{place.across.u * scale, place.across.v * scale};
        const UvStep down{place.down.u * scale, place.down.v * scale};
        const GrainPlace one{extent(place.u * scale, right.u, down.u),
                             extent(place.v * scale, right.v, down.v), right, down};
        const GrainPlace other{one.along, one.across, {right.v, right.u}, {down.v, down.u}};
        if (!std::isfinite(one.across.at) || !std::isfinite(one.along.at)) return kNoColor;

        const double size = std::max(one.across.size, one.along.size);
        const double tiles = (one.across.size + 2) * (one.along.size + 2);
        const double far = smooth_step(64, 128, tiles * (std::min(size, 1.0) / params.plankwidth + 2));
        Sum sum;
        if (far < 1) add_tiles(one, other, sum);
        const PatternColor near_color = with_gaps(sum);
        return far > 0 ? mix(near_color, mean_color(), far) : near_color;
    }

    PatternColor with_gaps(const Sum& sum) const {
        PatternColor out = pattern_color(params.spacecolor);
        for (std::size_t c = 0; c < 3; ++c) out[c] = out[c] * (1 - sum.covered) + sum.color[c];
        return out;
    }

    void add_tiles(const GrainPlace& one, const GrainPlace& other, Sum& sum) const {
        const double first_s = std::floor(one.across.from()), first_t = std::floor(one.along.from());
        const int columns = static_cast<int>(std::floor(one.across.to()) - first_s);
        const int rows = static_cast<int>(std::floor(one.along.to()) - first_t);
        for (int j = 0; j <= rows; ++j)
            for (int i = 0; i <= columns; ++i) {
                const double s = first_s + i, t = first_t + j, number = s + t;
                const bool turned = number - 2 * std::floor(number / 2) > 0;
                turned ? add_planks(other, t, s, sum) : add_planks(one, s, t, sum);
            }
    }

    // Those of the tile from `side` on across them and `row` on along them.
    void add_planks(const GrainPlace& place, double side, double row, Sum& sum) const {
        const double of_row = place.along.share(row + params.spacewidth, row + 1);
        if (!(of_row > 0)) return;
        const auto index = [&](double at) {
            return std::clamp(std::floor((at - side) / params.plankwidth), 0.0, planks - 1);
        };
        const int first = static_cast<int>(index(place.across.from()));
        const int last = static_cast<int>(index(place.across.to()));
        for (int k = first; k <= last; ++k) {
            const double from = side + k * params.plankwidth;
            const double to = k + 1 < planks ? from + params.plankwidth : side + 1;
            const double share = of_row * place.across.share(from + params.spacewidth, to);
            if (!(share > 0)) continue;
            const double column = side * planks + k;
            sum.add(share, plank_color(lightness(place, column), noise::signed_value(row * column + 0.7)));
        }
    }

    PatternColor plank_color(double light, double variation) const {
        PatternColor out = mix(pattern_color(params.ringcolor), pattern_color(params.woodcolor), light);
        const double bright = 1 - params.colorvariation / 2 + params.colorvariation * variation;
        for (double& c : out) c *= bright;
        return out;
    }

    double ring(double across, double along, double column) const {
        const double wave = params.wavefactor * noise::value(8 * across, along / 4);
        return params.ringfactor * noise::value(across - column, along / 4 + column + wave);
    }

    // The mean of the rings; of all of them where the pixel is as large as the noise that bends them.
    double lightness(const GrainPlace& place, double column) const {
        const double s = place.across.at, t = place.along.at;
        const double far = std::max(smooth_step(1.0 / 16, 1.0 / 8, place.across.size),
                                    smooth_step(0.5, 1, place.along.size));
        if (far == 1) return Rings::mean();
        const double here = ring(s, t, column);
        const double right = ring(s + place.right.u, t + place.right.v, column);
        const double down = ring(s + place.down.u, t + place.down.v, column);
        const double near_light = Rings::mean(extent(here, right - here, down - here));
        return near_light + (Rings::mean() - near_light) * far;
    }

    PatternColor mean_color() const {
        const auto wood = [&](double width) { return std::max(0.0, width - params.spacewidth); };
        const double last = 1 - (planks - 1) * params.plankwidth;
        const double share = wood(1) * ((planks - 1) * wood(params.plankwidth) + wood(last));
        Sum sum;
        sum.add(share, plank_color(Rings::mean(), 0));
        return with_gaps(sum);
    }
};

}  // namespace

KEYLINE_NODE(wood, Wood)

}  // namespace keyline
