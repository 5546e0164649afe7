// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/kit/strokes.h"
#include "engine/node/node_adaptor.h"

#include <cstdint>
#include <vector>

// Strokes of one frame as they lie in another: carried there frame by frame, by how what they are drawn on
// moves.

namespace KEYLINE_API keyline {

struct CarriedStrokes {
    static constexpr const char* kind = "carried strokes";

    Strokes strokes;
    // Of each vertex, in the order of strokes: whether what it is drawn on is still in view.
    std::vector<uint8_t> seen;

    std::size_t bytes() const { return strokes.bytes() + seen.size(); }
    friend bool operator==(const CarriedStrokes&, const CarriedStrokes&) = default;
};

// How far vertices go to the frame before, or to the next.
struct StrokeWays {
    static constexpr const char* kind = "ways of strokes";

    struct Way {
        double x = 0, y = 0;
        bool is_known = false;
        friend bool operator==(const Way&, const Way&) = default;
    };
    std::vector<Way> ways;  // in the order of strokes and vertices

    std::size_t bytes() const { return ways.size() * sizeof(Way); }
    friend bool operator==(const StrokeWays&, const StrokeWays&) = default;
};

// The operations: to begin with, then three for each frame on the way.

struct BeginCarrying {
    struct Params {
        Input strokes;
        static constexpr auto fields = declare(input(&Params::strokes, "strokes", "", data<Strokes>()));
    };
    static CarriedStrokes derive(const Inputs& in);
    static std::size_t datum_bytes() { return kUsualStrokes; }
};

// Motion is looked up on the right of strokes, on what they belong to: on the line itself samples are mixed
// of both sides.  What is thin is under its middle, in some pixels: there motion is other than beside it. The
// image has it as Cycles writes it, in X Y Z W.
struct FindWays {
    struct Params {
        Input vector, strokes;
        static constexpr auto fields =
            declare(input(&Params::vector, "vector", "", named("X", "Y", "Z", "W")),
                    input(&Params::strokes, "strokes", "", data<CarriedStrokes>()));
    };
    struct Sample {
        uint32_t vertex = 0, stroke = 0;
        bool is_middle = false;   // of something thin
        bool is_farther = false;  // from the line
        float x = 0, y = 0;
    };
    using State = std::vector<Sample>;
    using Partial = std::vector<Sample>;

    static State start(const Rect&) { return {}; }
    Partial map(const State&, const Inputs& in, const Rect& block, Scratch&) const;
    static void fold(State& state, Partial&& found) { state.insert(state.end(), found.begin(), found.end()); }
    static StrokeWays finish(State state);

    static constexpr std::size_t kUsual = kUsualStrokes / sizeof(StrokeVertex) * sizeof(Sample) * 2;
    static std::size_t state_bytes(const Rect&) { return kUsual; }
    static std::size_t partial_bytes(const Rect&) { return kUsual; }
    static std::size_t datum_bytes(const Rect&) { return kUsual; }

    const bool to_next;  // else to the frame before
};

struct GoWays {
    struct Params {
        Input strokes, ways;
        static constexpr auto fields = declare(input(&Params::strokes, "strokes", "", data<CarriedStrokes>()),
                                               input(&Params::ways, "ways", "", data<StrokeWays>()));
    };
    static CarriedStrokes derive(const Inputs& in);
    static std::size_t datum_bytes() { return kUsualStrokes; }
};

// Where the way back leads elsewhere, something came before it.
struct DropHidden {
    struct Params {
        Input strokes, ways, back;
        static constexpr auto fields = declare(input(&Params::strokes, "strokes", "", data<CarriedStrokes>()),
                                               input(&Params::ways, "ways", "", data<StrokeWays>()),
                                               input(&Params::back, "back", "", data<StrokeWays>()));
    };
    static CarriedStrokes derive(const Inputs& in);
    static std::size_t datum_bytes() { return kUsualStrokes; }
};

}  // namespace keyline
