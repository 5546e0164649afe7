// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/components.h"
#include "engine/node_adaptor.h"
#include "engine/rank.h"
#include "engine/simd/threshold.h"

#include <algorithm>
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

// Whole-frame: a component may cross every tile.  Thresholds that depend on the frame are found in rounds of
// their own; the last round finds the components.
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

    struct State {
        int round = 0;
        float low = 0, high = 0;
        float largest = -std::numeric_limits<float>::infinity();
        RankSearch ranks;
        ComponentMerger components;
    };

    // What a block adds in each round: its largest value, the ranks of its samples, or its components.
    using Partial = std::variant<float, RankSearch::Counts, BlockComponents>;

    int rounds() const { return units == Units::kAbsolute ? 1 : units == Units::kMax ? 2 : 3; }

    State start(const Rect& window) const {
        return {0,
                static_cast<float>(low),
                static_cast<float>(high),
                -std::numeric_limits<float>::infinity(),
                RankSearch({low, high}),
                ComponentMerger(window)};
    }

    std::size_t state_bytes(const Rect& window) const {
        return static_cast<std::size_t>(window.area() / 16 * 3) +
               (units == Units::kPercentile ? RankSearch::bytes() : 0);
    }

    Partial map(const State& state, const Inputs& inputs, const Rect& block, Scratch& scratch) const {
        const View& view = inputs[in][0];
        if (state.round == rounds() - 1) return components(state, view, block, scratch);
        if (units == Units::kMax) return largest(view);
        return state.ranks.count(view);
    }

    void fold(State& state, Partial&& partial) const {
        if (auto* value = std::get_if<float>(&partial)) state.largest = std::max(state.largest, *value);
        if (auto* counts = std::get_if<RankSearch::Counts>(&partial)) state.ranks.add(*counts);
        if (auto* block = std::get_if<BlockComponents>(&partial)) state.components.add(std::move(*block));
    }

    void finish(State& state) const {
        const bool last = ++state.round == rounds();
        if (last) return state.components.finish();
        if (units == Units::kMax) {
            state.low = static_cast<float>(low * static_cast<double>(state.largest));
            state.high = static_cast<float>(high * static_cast<double>(state.largest));
            return;
        }
        state.ranks.finish_round();
        if (state.round == rounds() - 1) {
            // Without a sample every comparison fails.
            state.low = state.ranks.value(0).value_or(std::numeric_limits<float>::quiet_NaN());
            state.high = state.ranks.value(1).value_or(std::numeric_limits<float>::quiet_NaN());
        }
    }

    void compute(const State& state, Outputs out, Scratch& scratch) const {
        const MutView& edge = out[0];
        const int n = edge.rect.width();
        const auto bits = scratch.take<uint64_t>(static_cast<std::size_t>(simd::words_for(n)));
        for (int y = edge.rect.y0; y < edge.rect.y1; ++y) {
            state.components.kept().copy_row(y, edge.rect.x0, n, bits.data());
            simd::expand_row(bits.data(), n, edge.row(y));
        }
    }

    const Input in;
    const double low, high;
    const Units units;

private:
    static BlockComponents components(const State& state, const View& view, const Rect& block,
                                      Scratch& scratch) {
        BitRows weak(block), strong(block);
        for (int y = block.y0; y < block.y1; ++y)
            simd::threshold_row(view.row(y), block.width(), state.low, state.high, weak.row(y),
                                strong.row(y));
        return find_components(weak, strong, scratch);
    }

    static float largest(const View& view) {
        float most = -std::numeric_limits<float>::infinity();
        for (int y = view.rect.y0; y < view.rect.y1; ++y)
            for (int i = 0; i < view.rect.width(); ++i) most = view.row(y)[i] > most ? view.row(y)[i] : most;
        return most;
    }
};

}  // namespace

KEYLINE_NODE(hysteresis, Hysteresis)

}  // namespace keyline
