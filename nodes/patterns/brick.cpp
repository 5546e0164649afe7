// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/noise.h"
#include "engine/kit/uv_map.h"

namespace keyline {

namespace {

// Equal parts of an axis, again and again: `length` from `start` on in every `period`.
struct Pulses {
    double period, start, length;

    double up_to(double at) const {
        const double whole = std::floor(at / period);
        return whole * length + std::clamp(at - whole * period - start, 0.0, length);
    }
    double share(const Extent& e) const {
        if (!e.is_point()) return std::clamp((up_to(e.to()) - up_to(e.from())) / e.size, 0.0, 1.0);
        const double inside = e.at - std::floor(e.at / period) * period - start;
        return inside >= 0 && inside < length ? 1 : 0;
    }
};

// What a pixel sees of the wall, in bricks: s along the rows, t from row to row.
struct WallPlace {
    Extent s, t;

    // More than this, and no brick is told from another.
    double cells() const { return (s.size + 2) * (t.size + 2); }
};

struct Brick {
    static constexpr Info info{"brick", "A wall of bricks with mortar between them, on surface coordinates."};

    struct Params {
        Input uv;
        double brickwidth = 0.25, brickheight = 0.12, mortarwidth = 0.05, irregularity = 0.06,
               texturescale = 2, colorvariation = 0.5;
        Color brickcolor{0.83, 0.01, 0.12}, mortarcolor{0.5, 0.5, 0.5};

        static constexpr auto fields = declare(
            input(&Params::uv, "uv",
                  "U V, or S T.  Where there is an A they are premultiplied by it, and the wall is as "
                  "transparent as it says."),
            field(&Params::brickwidth, "brickwidth", "In surface units, at a texturescale of 1.",
                  between(1e-6, 1e6).tested_to(1)),
            field(&Params::brickheight, "brickheight", "Likewise.", between(1e-6, 1e6).tested_to(1)),
            field(&Params::mortarwidth, "mortarwidth", "Of a brick's width, and of its height.",
                  between(0, 1)),
            field(&Params::irregularity, "irregularity",
                  "By how much the wall is bent, in surface units at a texturescale of 1.",
                  at_least(0).tested_to(1)),
            field(&Params::texturescale, "texturescale", "How much smaller everything is.",
                  between(1e-6, 1e6).tested_to(8)),
            field(&Params::colorvariation, "colorvariation", "How much brighter a brick may be.",
                  between(0, 100).tested_to(2)),
            field(&Params::brickcolor, "brickcolor", "Of the darkest brick."),
            field(&Params::mortarcolor, "mortarcolor", "Of what is between bricks."));
    };
    static constexpr std::array outputs{"R", "G", "B", "A"};

    explicit Brick(const Params& p) : params(p) {}

    Stream expand(Builder& builder) const {
        return add_pattern(builder, params.uv, 400,
                           [wall = *this](const UvPlace& place) { return wall.color(place); });
    }

    const Params params;

private:
    struct Point {
        double s, t;
    };

    // Bent by a noise of two components, `visible` of it.
    Point bent(double u, double v, double visible) const {
        const noise::Pair by = noise::pair(u / params.brickwidth, v / params.brickheight);
        const double x = 0.5 + (by.x - 0.5) * visible, y = 0.5 + (by.y - 0.5) * visible;
        return {(u + params.irregularity * x) * params.texturescale / params.brickwidth,
                (v + params.irregularity * y) * params.texturescale / params.brickheight};
    }

    // A pixel larger than the noise that bends the wall sees its mean, and the bricks smeared by it.
    WallPlace wall_at(const UvPlace& p) const {
        constexpr double kNoiseWidth = 0.5;  // of an even distribution that spreads as much as the noise
        const double periods = std::max((std::abs(p.across.u) + std::abs(p.down.u)) / params.brickwidth,
                                        (std::abs(p.across.v) + std::abs(p.down.v)) / params.brickheight);
        const double visible = 1 - smooth_step(0.5, 2, periods);
        const double smear = (1 - visible) * kNoiseWidth * params.irregularity * params.texturescale;
        const Point here = bent(p.u, p.v, visible);
        const Point across = bent(p.u + p.across.u, p.v + p.across.v, visible);
        const Point down = bent(p.u + p.down.u, p.v + p.down.v, visible);
        WallPlace wall{extent(here.s, across.s - here.s, down.s - here.s),
                       extent(here.t, across.t - here.t, down.t - here.t)};
        wall.s.size += smear / params.brickwidth;
        wall.t.size += smear / params.brickheight;
        return wall;
    }

    PatternColor color(const UvPlace& place) const {
        const WallPlace wall = wall_at(place);
        if (!std::isfinite(wall.s.at) || !std::isfinite(wall.t.at)) return kNoColor;
        const double far = smooth_step(36, 100, wall.cells());
        const PatternColor near_color = far < 1 ? brick_by_brick(wall) : PatternColor{};
        return far > 0 ? mix(near_color, all_bricks(wall), far) : near_color;
    }

    static double shift(double row) { return row - 2 * std::floor(row / 2) > 0 ? 0.5 : 0; }

    // `covered` of it is bricks, together `bright` times as bright as one.
    PatternColor blend(double covered, double bright) const {
        PatternColor out = pattern_color(params.mortarcolor);
        const PatternColor brick = pattern_color(params.brickcolor);
        for (std::size_t c = 0; c < 3; ++c) out[c] = out[c] * (1 - covered) + brick[c] * bright;
        return out;
    }

    PatternColor brick_by_brick(const WallPlace& wall) const {
        double covered = 0, bright = 0;
        const double first_row = std::floor(wall.t.from());
        const int rows = static_cast<int>(std::floor(wall.t.to()) - first_row);
        for (int i = 0; i <= rows; ++i) {
            const double row = first_row + i, of_row = wall.t.share(row + params.mortarwidth, row + 1);
            const Extent s{wall.s.at + shift(row), wall.s.size};
            const double first_column = std::floor(s.from());
            const int columns = static_cast<int>(std::floor(s.to()) - first_column);
            for (int j = 0; j <= columns && of_row > 0; ++j) {
                const double column = first_column + j;
                const double share = of_row * s.share(column + params.mortarwidth, column + 1);
                covered += share;
                bright += share * (1 + params.colorvariation * noise::value(column * row / 2.3 + 3.7));
            }
        }
        return blend(covered, bright);
    }

    // So many that the mean of the noise, ½, does for each.
    PatternColor all_bricks(const WallPlace& wall) const {
        const double m = params.mortarwidth;
        const Pulses columns{1, m, 1 - m}, even_rows{2, m, 1 - m}, odd_rows{2, 1 + m, 1 - m};
        const Extent shifted{wall.s.at + 0.5, wall.s.size};
        const double covered =
            even_rows.share(wall.t) * columns.share(wall.s) + odd_rows.share(wall.t) * columns.share(shifted);
        return blend(covered, covered * (1 + params.colorvariation / 2));
    }
};

}  // namespace

KEYLINE_NODE(brick, Brick)

}  // namespace keyline
