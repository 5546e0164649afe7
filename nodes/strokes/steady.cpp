// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/steady_strokes.h"
#include "engine/node/node_adaptor.h"

#include <cstdlib>

namespace keyline {

namespace {

// This frame's strokes, and for each frame beside what lies there and what of here is seen from there.
struct Settle {
    Strokes derive(const Inputs& in) const {
        std::vector<FrameBeside> frames;
        int slot = 1;
        for (const int since : beside) {
            frames.push_back({since, &in.datum<CarriedStrokes>(slot), &in.datum<CarriedStrokes>(slot + 1)});
            slot += 2;
        }
        return steadied(in.datum<Strokes>(0), frames);
    }
    static std::size_t datum_bytes() { return kUsualStrokes; }

    const std::vector<int> beside;  // frames later
};

struct Steady {
    static constexpr Info info{"steady",
                               "Strokes that hold together over frames: calm, and without blinking."};
    using Gives = Strokes;

    struct Params {
        Input in, vector;
        int frames = 2;

        static constexpr auto fields = declare(
            input(&Params::in, "in", "The strokes.", data<Strokes>()),
            input(
                &Params::vector, "vector",
                "How pixels move, as Cycles' Vector has it: from here, y up, to where they were in the frame "
                "before (X, Y), and from there to where they will be in the next, negative (Z, W).",
                named("X", "Y", "Z", "W")),
            field(
                &Params::frames, "frames",
                "How many frames before and after are looked at. Where the shot has ended, let \"missing\": "
                "\"black\" of read stand for them: a frame without strokes has no say.",
                between(1, 2)));
    };

    explicit Steady(const Params& p) : params(p) {}

    Stream expand(Builder& builder) const {
        const int here = builder.frame();
        std::vector<Port> ports{port(builder.input(params.in), data<Strokes>())};
        std::vector<int> beside;
        for (int since = -params.frames; since <= params.frames; ++since) {
            if (since == 0) continue;
            beside.push_back(since);
            for (const auto& [from, to] : {std::pair(here + since, here), std::pair(here, here + since)})
                ports.push_back(port(carried(builder, from, to), data<CarriedStrokes>()));
        }
        return add_operation(builder, std::make_shared<const Settle>(Settle{beside}), ports);
    }

    const Params params;

private:
    static Port port(Stream stream, const Takes& takes) { return {takes, false, true, std::move(stream)}; }

    // A frame's strokes in another, through all between.
    Stream carried(Builder& builder, int from, int to) const {
        Stream strokes = add_operation(builder, BeginCarrying{}, {builder.input(params.in, from)});
        const int step = to > from ? 1 : -1;
        for (int frame = from; frame != to; frame += step) {
            const Stream vector = builder.input(params.vector, frame),
                         vector_there = builder.input(params.vector, frame + step);
            const Stream ways = add_operation(builder, FindWays{step > 0}, {vector, strokes});
            strokes = add_operation(builder, GoWays{}, {strokes, ways});
            const Stream back = add_operation(builder, FindWays{step < 0}, {vector_there, strokes});
            strokes = add_operation(builder, DropHidden{}, {strokes, ways, back});
        }
        return strokes;
    }
};

}  // namespace

KEYLINE_NODE(steady, Steady)

}  // namespace keyline
