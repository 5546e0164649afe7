// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/node/node_adaptor.h"
#include "engine/node/pixel_loop.h"

#include <algorithm>
#include <fmt/format.h>

namespace keyline {

namespace {

enum class Interpolation { kConstant, kLinear, kSmooth };

constexpr auto words(Interpolation) {
    using W = Word<Interpolation>;
    return std::array{W{"constant", Interpolation::kConstant, "bands: a stop's value from its position on"},
                      W{"linear", Interpolation::kLinear, "a straight line from stop to stop"},
                      W{"smooth", Interpolation::kSmooth, "a smooth step from stop to stop"}};
}

using Tone = std::variant<double, Color>;
using Stop = std::pair<double, Tone>;

std::array<double, 3> rgb(const Tone& tone) {
    if (const auto* grey = std::get_if<double>(&tone)) return {*grey, *grey, *grey};
    const Color& c = std::get<Color>(tone);
    return {c.r, c.g, c.b};
}

struct Ramp {
    static constexpr Info info{"ramp", "Tones for the values of a matte: bands, or a gradient."};

    struct Params {
        Input in;
        std::vector<Stop> stops;
        Interpolation interpolation = Interpolation::kConstant;
        double softness = 0;

        static constexpr auto fields = declare(
            input(&Params::in, "in", "What is looked up: light, or any other matte.", matte()),
            field(
                &Params::stops, "stops",
                "A list of [position, colour or number], the lowest first; below the first its value holds.")
                .required(),
            field(&Params::interpolation, "interpolation", "What lies between the stops."),
            field(&Params::softness, "softness",
                  "With constant: over how much of the matte a band fades into the next, centred.",
                  at_least(0).tested_to(1)));
    };

    static void check(const Params& p, Check& c) {
        if (p.stops.empty())
            return c.error("stops", "there are no stops", "give one [position, value] at least");
        for (std::size_t i = 1; i < p.stops.size(); ++i)
            if (p.stops[i].first < p.stops[i - 1].first)
                return c.error("stops",
                               fmt::format("the stop at {} follows the one at {}", p.stops[i].first,
                                           p.stops[i - 1].first),
                               "sort them by position");
        if (p.softness > 0 && p.interpolation != Interpolation::kConstant)
            c.error("softness", "only constant bands have a softness", "leave it out");
    }

    explicit Ramp(const Params& p) : in(p.in), first(rgb(p.stops[0].second)), coloured(has_colour(p)) {
        for (std::size_t i = 1; i < p.stops.size(); ++i) rises.push_back(rise(p, i));
    }

    // R G B, or Y where all stops are numbers.
    Makes makes(const std::vector<Port>&) const {
        return coloured ? Makes{{"R", "G", "B"}, false} : Makes{{"Y"}, false};
    }

    double cost() const { return 10.0 * static_cast<double>(rises.size()); }

    // NaN is below the first stop.
    void compute(const Inputs& inputs, Outputs out, Scratch& scratch) const {
        const auto sum = scratch.take<double>(static_cast<std::size_t>(out[0].rect.width()));
        for (int y = out[0].rect.y0; y < out[0].rect.y1; ++y)
            for (std::size_t c = 0; c < out.size(); ++c) {
                std::ranges::fill(sum, first[c]);
                for (const Rise& r : rises) add(r, r.by[c], inputs[in][0].row(y), sum);
                std::ranges::transform(sum, out[c].row(y), [](double v) { return static_cast<float>(v); });
            }
    }

    // From one stop's value to the next one's, between two values of the input.
    struct Rise {
        double from, to;
        bool smooth;
        std::array<double, 3> by;
    };

    const Input in;
    const std::array<double, 3> first;
    const bool coloured;
    std::vector<Rise> rises;

private:
    static bool has_colour(const Params& p) {
        return std::ranges::any_of(p.stops,
                                   [](const Stop& s) { return std::holds_alternative<Color>(s.second); });
    }

    static Rise rise(const Params& p, std::size_t i) {
        const bool bands = p.interpolation == Interpolation::kConstant;
        const double here = p.stops[i].first, before = p.stops[i - 1].first;
        Rise r{bands ? here - p.softness / 2 : before, bands ? here + p.softness / 2 : here,
               p.interpolation != Interpolation::kLinear, rgb(p.stops[i].second)};
        const std::array<double, 3> last = rgb(p.stops[i - 1].second);
        for (std::size_t c = 0; c < 3; ++c) r.by[c] -= last[c];
        return r;
    }

    static void add(const Rise& rise, double by, const float* in, std::span<double> sum) {
        const double from = rise.from, length = rise.to - rise.from;
        for (std::size_t i = 0; i < sum.size(); ++i) {
            const double x = in[i];
            const double inside = (x - from) / length;  // not used where the length is 0
            const double t = x >= rise.to ? 1.0 : x > from ? inside : 0.0;
            sum[i] += by * (rise.smooth ? t * t * (3 - 2 * t) : t);
        }
    }
};

}  // namespace

KEYLINE_NODE(ramp, Ramp)

}  // namespace keyline
