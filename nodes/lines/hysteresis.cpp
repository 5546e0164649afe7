// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/components.h"
#include "engine/kit/numbers.h"
#include "engine/node/node_adaptor.h"
#include "engine/simd/nms.h"
#include "engine/simd/threshold.h"

#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace keyline {

namespace {

enum class Units { kAbsolute, kMax, kPercentile };

constexpr auto words(Units) {
    return std::array{
        Word<Units>{"absolute", Units::kAbsolute, "as they are"},
        Word<Units>{"max", Units::kMax, "0 to 1 of the frame's largest value"},
        Word<Units>{"percentile", Units::kPercentile, "0 to 100 of the frame's samples that are not 0"}};
}

// From two percentiles to the numbers that an edge is above and reaches: what equals a percentile, as nms has
// it, counts as above it.
struct CountEquals {
    struct Params {
        Input percentiles;
        static constexpr auto fields =
            declare(input(&Params::percentiles, "percentiles", "", data<Numbers>()));
    };
    static Numbers derive(const Inputs& in) {
        const std::vector<double>& p = in.datum<Numbers>(0).values;
        const auto least = [](double v) {
            const auto value = static_cast<float>(v);
            return value - std::fabs(value) * simd::kEqual;
        };
        return {{std::nextafter(least(p[0]), -std::numeric_limits<float>::infinity()), least(p[1])}};
    }
    static std::size_t datum_bytes() { return 2 * sizeof(double); }
};

// The pixels of weak edges that hang together with a strong one.
struct FindEdges {
    struct Params {
        Input strength, thresholds;
        static constexpr auto fields = declare(input(&Params::strength, "strength", "", matte("magnitude")),
                                               input(&Params::thresholds, "thresholds", "", data<Numbers>()));
    };
    using State = ComponentMerger;
    using Partial = BlockComponents;

    static State start(const Rect& window) { return ComponentMerger(window); }
    static Partial map(const State&, const Inputs& in, const Rect& block, Scratch& scratch) {
        const View& strength = in.slot(0)[0];
        const std::vector<double>& limits = in.datum<Numbers>(1).values;
        const auto low = static_cast<float>(limits[0]), high = static_cast<float>(limits[1]);
        BitRows weak(block), strong(block);
        for (int y = block.y0; y < block.y1; ++y)
            simd::threshold_row(strength.row(y), block.width(), low, high, weak.row(y), strong.row(y));
        return find_components(weak, strong, scratch);
    }
    static void fold(State& state, Partial&& block) { state.add(std::move(block)); }
    static BitRows finish(State state) { return state.finish(); }

    static std::size_t state_bytes(const Rect& window) { return BitRows::bytes_for(window) / 2; }
    static std::size_t partial_bytes(const Rect& block) { return 2 * BitRows::bytes_for(block); }
    static std::size_t datum_bytes(const Rect& window) { return BitRows::bytes_for(window); }
};

// 1 where a bitmap is set.
struct DrawBits {
    struct Params {
        Input bits;
        static constexpr auto fields = declare(input(&Params::bits, "bits", "", data<BitRows>()));
    };
    static constexpr std::array outputs{"edge"};
    static void compute(const Inputs& in, Outputs out, Scratch& scratch) {
        const BitRows& bits = in.datum<BitRows>(0);
        const MutView& edge = out[0];
        const int n = edge.rect.width();
        const auto row = scratch.take<uint64_t>(static_cast<std::size_t>(simd::words_for(n)));
        for (int y = edge.rect.y0; y < edge.rect.y1; ++y) {
            bits.copy_row(y, edge.rect.x0, n, row.data());
            simd::expand_row(row.data(), n, edge.row(y));
        }
    }
};

// A component may cross every tile: it is gathered over the whole frame, and drawn by a point operation.
struct Hysteresis {
    static constexpr Info info{"hysteresis", "Keeps weak edges that hang together with a strong one."};

    struct Params {
        Input in;
        double low = 0;
        std::optional<double> high;
        Units units = Units::kAbsolute;

        static constexpr auto fields = declare(
            input(&Params::in, "in", "The strength of edges; the magnitude of nms.", matte("magnitude")),
            field(&Params::low, "low", "Pixels above this may be part of an edge.", at_least(0).tested_to(1))
                .required(),
            field(&Params::high, "high", "An edge holds a pixel of at least this; 3 × low when absent.",
                  at_least(0).tested_to(1)),
            field(&Params::units, "units", "What low and high are measured in."));
    };
    static constexpr std::array outputs{"edge"};

    static void check(const Params& p, Check& c) {
        if (p.units == Units::kPercentile && !p.high)
            c.error("units", "'high' is missing; with percentiles it has no default",
                    "give a 'high' up to 100");
        const double most = p.units == Units::kPercentile ? 100 : std::numeric_limits<double>::infinity();
        if (p.low > most) c.error("low", fmt::format("'low' is {}; a percentile is at most 100", p.low));
        if (p.high && *p.high > most)
            c.error("high", fmt::format("'high' is {}; a percentile is at most 100", *p.high));
        if (p.high && p.low > *p.high)
            c.error("low",
                    fmt::format("'low' is {}; it must not be above 'high', which is {}", p.low, *p.high));
    }

    explicit Hysteresis(const Params& p)
        : in(p.in), low(p.low), high(p.high.value_or(3 * p.low)), units(p.units) {}

    Stream expand(Builder& builder) const {
        Stream strength = builder.input(in);
        tell_of_slope(builder, strength);
        strength.channels = {{"magnitude", take_channels(builder, strength, matte("magnitude")).front()}};
        const Stream bits = add_operation(builder, FindEdges{}, {strength, thresholds(builder, strength)});
        return add_operation(builder, DrawBits{}, {bits});
    }

    const Input in;
    const double low, high;
    const Units units;

private:
    // What is wide before is wide behind.
    static void tell_of_slope(Builder& builder, const Stream& strength) {
        const StreamChannel* magnitude = strength.find_spelled("magnitude");
        if (magnitude && magnitude->nature.slope)
            builder.warn(Code::kNotThinned, "the slope is as wide as its blur, and so will the lines be",
                         "put an 'nms' before it, which thins it");
    }

    Stream thresholds(Builder& builder, const Stream& strength) const {
        if (units == Units::kAbsolute) return add_operation(builder, Fixed{{low, high}}, {});
        if (units == Units::kPercentile)
            return add_operation(builder, CountEquals{},
                                 {add_operation(builder, Percentiles{{low, high}}, {strength})});
        return add_operation(builder, Multiples{{low, high}},
                             {add_operation(builder, Largest{}, {strength})});
    }
};

}  // namespace

KEYLINE_NODE(hysteresis, Hysteresis)

}  // namespace keyline
