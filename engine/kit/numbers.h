// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/kit/rank.h"
#include "engine/node/node.h"
#include "engine/params/params.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

// Numbers that a whole frame has, as data: nodes gather them, and any node may take them.

namespace KEYLINE_API keyline {

struct Numbers {
    static constexpr const char* kind = "numbers";
    std::vector<double> values;

    std::size_t bytes() const { return values.size() * sizeof(double); }
    // By their bits: a NaN is the same as itself.
    friend bool operator==(const Numbers& a, const Numbers& b) {
        return std::ranges::equal(a.values, b.values, {}, std::bit_cast<uint64_t, double>,
                                  std::bit_cast<uint64_t, double>);
    }
};

// Numbers that are known beforehand, for a port that else takes the frame's.
struct Fixed {
    struct Params {
        static constexpr auto fields = declare();
    };
    Numbers derive(const Inputs&) const { return {{values.begin(), values.end()}}; }
    static std::size_t datum_bytes() { return 2 * sizeof(double); }

    const std::array<double, 2> values;
};

// Multiples of one number.
struct Multiples {
    struct Params {
        Input of;
        static constexpr auto fields = declare(input(&Params::of, "of", "", data<Numbers>()));
    };
    Numbers derive(const Inputs& in) const {
        const double unit = in.datum<Numbers>(0).values[0];
        return {{factors[0] * unit, factors[1] * unit}};
    }
    static std::size_t datum_bytes() { return 2 * sizeof(double); }

    const std::array<double, 2> factors;
};

// A gather of one number: the frame's largest sample, -inf where there is none.
struct Largest {
    struct Params {
        Input in;
        static constexpr auto fields = declare(input(&Params::in, "in", "", any_channels()));
    };
    using State = float;
    using Partial = float;
    static State start(const Rect&) { return -std::numeric_limits<float>::infinity(); }
    static Partial map(State, const Inputs& in, const Rect& block, Scratch&);
    static void fold(State& state, Partial largest) { state = std::max(state, largest); }
    static Numbers finish(State state) { return {{state}}; }
    static std::size_t state_bytes(const Rect&) { return sizeof(State); }
    static std::size_t partial_bytes(const Rect&) { return sizeof(Partial); }
    static std::size_t datum_bytes(const Rect&) { return sizeof(double); }
};

// A gather of a number for each percentile, see RankSearch; NaN where no sample counts.
struct Percentiles {
    using Params = Largest::Params;
    using State = RankSearch;
    using Partial = RankSearch::Counts;
    static int rounds() { return 2; }
    State start(const Rect&) const { return RankSearch(percentiles); }
    static Partial map(const State& state, const Inputs& in, const Rect&, Scratch&) {
        return state.count(in.slot(0)[0]);
    }
    static void fold(State& state, Partial&& counts) { state.add(counts); }
    static void end_round(State& state) { state.finish_round(); }
    static Numbers finish(State state);
    static std::size_t state_bytes(const Rect&) { return RankSearch::bytes(); }
    static std::size_t partial_bytes(const Rect& block) { return RankSearch::bytes_of_counts(block); }
    static std::size_t datum_bytes(const Rect&) { return 2 * sizeof(double); }

    const std::array<double, 2> percentiles;
};

}  // namespace keyline
