// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0

// A program outside of Keyline that has a node of its own:
//     posterise GRAPH.json PLATE.exr OUT.exr

#include <cmath>
#include <engine/graph/graph.h>
#include <engine/node/node_adaptor.h>
#include <engine/node/pixel_loop.h>
#include <engine/node/registry.h>
#include <engine/run/render.h>
#include <iostream>

namespace {

using namespace keyline;

struct Posterise {
    static constexpr Info info{"posterise", "Rounds every channel to a few steps."};

    struct Params {
        Input in;
        int steps = 4;

        static constexpr auto fields =
            declare(input(&Params::in, "in", "The image; each channel by itself."),
                    field(&Params::steps, "steps", "How many there are between 0 and 1.", between(1, 256)));
    };

    explicit Posterise(const Params& p) : steps(static_cast<float>(p.steps)) {}

    void compute(const View& in, const MutView& out, Scratch&) const {
        for_each_pixel(
            out, [this](float v) { return std::floor(v * steps + 0.5F) / steps; }, in);
    }

    const float steps;
};

struct Console : RenderObserver {
    void frame_ended(int frame, FrameOutcome) override { std::cout << "frame " << frame << '\n'; }
    void error(const Error& e) override { std::cerr << e.text() << '\n'; }
};

int run(const char* file, const char* plate, const char* out) {
    registry().add(make_node_type<Posterise>());
    Diagnostics diagnostics;
    LoadOptions load;
    load.var = {{"plate", plate, "PLATE"}, {"out", out, "OUT"}};
    const auto graph = Graph::load(file, load, diagnostics);
    for (const Error& e : diagnostics.errors()) std::cerr << e.text() << '\n';
    if (!graph) return 2;
    RenderOptions options;
    options.frames = {1};
    Console console;
    const std::atomic<bool> cancel = false;
    return render(*graph, options, console, cancel).status();
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 4) return 2;
    return run(argv[1], argv[2], argv[3]);
}
