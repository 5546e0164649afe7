// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/strokes.h"

#include "engine/node/node_adaptor.h"
#include "engine/node/registry.h"
#include "engine/plan/planner.h"
#include "engine/plan/resolve.h"

#include <cmath>
#include <random>

namespace keyline::testing {

namespace {

// What the graph of this process reads.
Strokes& given() {
    static Strokes strokes;
    return strokes;
}

class Giving final : public Derivation {
public:
    explicit Giving(Strokes strokes) : datum_(make_datum(std::move(strokes))) {}
    const char* gives() const override { return Strokes::kind; }
    std::shared_ptr<const Datum> derive(const Inputs&) const override { return datum_; }
    std::size_t datum_bytes() const override { return datum_->bytes(); }

private:
    std::shared_ptr<const Datum> datum_;
};

Stream source_of(Builder& builder, const Strokes& strokes) {
    Stream stream = builder.add_source(std::make_shared<const Giving>(strokes));
    stream.display = strokes.display;
    stream.window = strokes.window;
    return stream;
}

struct GivenStrokes {
    static constexpr Info info{"given_strokes", "Strokes of the test."};
    using Gives = Strokes;
    struct Params {
        static constexpr auto fields = declare();
    };
    explicit GivenStrokes(const Params&) {}
    static Stream read(Builder& builder) { return source_of(builder, given()); }
};

struct RandomStrokes {
    static constexpr Info info{"random_strokes", "Strokes with some of everything."};
    using Gives = Strokes;
    struct Params {
        int seed = 1;
        static constexpr auto fields =
            declare(field(&Params::seed, "seed", "Which strokes.", between(0, 1000)));
    };
    explicit RandomStrokes(const Params& p) : seed(p.seed) {}
    Stream read(Builder& builder) const {
        return source_of(builder, random_strokes(static_cast<unsigned>(seed), {-3, 2, 40, 32}));
    }
    const int seed;
};

template <class Node>
void register_once() {
    if (!registry().find(Node::info.name)) registry().add(make_node_type<Node>());
}

// Draws that are the same everywhere: those of the library are not.
class Dice {
public:
    explicit Dice(unsigned seed) : random_(seed) {}
    int whole(int low, int high) {
        return low + static_cast<int>(random_() % static_cast<unsigned>(high - low + 1));
    }
    double number(double low, double high) { return low + (high - low) * whole(0, 1 << 16) / (1 << 16); }

private:
    std::mt19937 random_;
};

// A way that bends a little at every step, and now and then sharply.
Places walk(Dice& dice, const Rect& window, int steps) {
    double x = dice.number(window.x0, window.x1), y = dice.number(window.y0, window.y1);
    double dx = dice.number(-1, 1), dy = 1;
    Places out;
    for (int i = 0; i < steps; ++i) {
        const double length = std::sqrt(dx * dx + dy * dy);
        x += dx / length;
        y += dy / length;
        out.emplace_back(x, y);
        const double turn = dice.whole(0, 15) == 0 ? dice.number(-3, 3) : dice.number(-0.15, 0.15);
        dx = (dx - turn * dy) / length;
        dy = (dy + turn * dx) / length;
    }
    return out;
}

Stroke random_stroke(Dice& dice, const Rect& window) {
    Stroke s = stroke(walk(dice, window, dice.whole(2, 60)), 1,
                      static_cast<StrokeKind>(dice.whole(0, static_cast<int>(StrokeKind::kUser))),
                      dice.whole(0, 2) == 0);
    s.near = static_cast<uint32_t>(dice.whole(0, 3));
    s.far = static_cast<uint32_t>(dice.whole(0, 3));
    for (StrokeEnd& end : s.ends) end = static_cast<StrokeEnd>(dice.whole(0, 3));
    s.anchor = static_cast<StrokeAnchor>(dice.whole(0, 3));
    if (dice.whole(0, 3) == 0) s.color = Color{dice.number(0, 1), dice.number(0, 1), 0.5};
    const bool even = dice.whole(0, 1) == 0;
    for (StrokeVertex& v : s.vertices) {
        v.width = even ? 2 : dice.number(0, 4);
        v.opacity = even ? 1 : dice.number(0, 1);
        v.depth = dice.number(0.5, 20);
        v.curvature = dice.number(-0.5, 0.5);
        v.strength = dice.number(0, 1);
        v.sharpness = dice.number(0, 180);
        v.epsilon = dice.number(0, 0.3);
        v.thickness = even ? 0 : 10 * v.epsilon;
        if (s.anchor != StrokeAnchor::kNone)
            for (double& a : v.anchor) a = dice.number(-2, 2);
    }
    return s;
}

Json with_node(const std::string& type, Json node, const std::map<std::string, Image>& images,
               Sequences& sequences) {
    register_once<GivenStrokes>();
    node.set("type", type);
    if (!node.has("in")) node.set("in", "strokes");
    for (const auto& [port, image] : images) {
        node.set(port, "input-" + port);
        sequences["input-" + port] = {image};
    }
    return {{"strokes", {{"type", "given_strokes"}}}, {"node", node}};
}

}  // namespace

Stroke stroke(const Places& places, double width, StrokeKind kind, bool closed) {
    Stroke out;
    out.kind = kind;
    out.closed = closed;
    for (const auto& [x, y] : places) {
        StrokeVertex v;
        v.x = x;
        v.y = y;
        v.width = width;
        out.vertices.push_back(v);
    }
    return out;
}

Strokes strokes_in(const Rect& window, std::vector<Stroke> strokes) {
    Strokes out;
    out.display = out.window = window;
    out.strokes = std::move(strokes);
    arrange(out);
    return out;
}

Strokes random_strokes(unsigned seed, const Rect& window) {
    Dice dice(seed);
    std::vector<Stroke> strokes;
    for (int n = dice.whole(0, 5); n > 0; --n) strokes.push_back(random_stroke(dice, window));
    Strokes out = strokes_in(window, std::move(strokes));
    out.names = {{1, "cup"}, {2, "hair.left"}, {3, "Größe \"3\""}};
    arrange(out);
    return out;
}

void register_random_strokes() { register_once<RandomStrokes>(); }

Strokes run_on_strokes(const std::string& type, const Json& params, const Strokes& in,
                       const RunOptions& options, const std::map<std::string, Image>& images) {
    given() = in;
    Sequences sequences;
    const Json nodes = with_node(type, params, images, sequences);
    ResolvedFrame frame = resolve_graph(nodes, {}, sequences, options.frame, true, {"node"});
    render(make_plan(std::move(frame), {options.threads, options.tile, options.memory}));
    return datum_as<Strokes>(*rendered_data().front());
}

Image draw_strokes(const std::string& type, const Json& params, const Strokes& in, const RunOptions& options,
                   const std::map<std::string, Image>& images) {
    given() = in;
    Sequences sequences;
    const Json nodes = with_node(type, params, images, sequences);
    return run_graph(nodes, "node", sequences, options);
}

}  // namespace keyline::testing
