// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0

// Nodes on a picture in memory:  bench_kernels PLATE.exr [options of Google Benchmark]
// Graphs go through planner and executor, on 1, 2, 4, … threads; `copy` computes nothing, and is what any
// node pays for getting its pixels in and out.  Dilations are computed alone, by one thread.

#include "bench/memory_graph.h"
#include "bench/plate.h"
#include "bench/tiled_node.h"

#include <algorithm>
#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <functional>
#include <iostream>
#include <memory>
#include <string>
#include <thread>

namespace keyline::bench {
namespace {

struct Pictures {
    Picture beauty, grey, mask, passes;
};

std::size_t index_of(const Picture& picture, int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
           static_cast<std::size_t>(x);
}

// What is hard for hysteresis: values between its thresholds, and one pixel that decides for all that hang
// together with it.
Picture weak_where(int width, int height, const std::function<bool(int, int)>& line) {
    Picture picture(width, height, {"Y"});
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) picture.planes[0][index_of(picture, x, y)] = line(x, y) ? 0.5F : 0.0F;
    picture.planes[0][index_of(picture, 0, 0)] = 1;
    return picture;
}

// One line from the corner to the middle, with as much room between its turns as it is wide.
bool on_spiral(int x, int y, int width, int height) {
    const int ring = std::min({x, y, width - 1 - x, height - 1 - y});
    const bool entry = x == ring - 1 && y == ring;  // from the ring around to this one
    const bool opened = x == ring && y == ring + 1;
    return ring % 2 == 0 ? !opened : entry;
}

bool is_noise(int x, int y) {
    const auto hash = (static_cast<unsigned>(x) * 0x9E3779B1U) ^ (static_cast<unsigned>(y) * 0x85EBCA77U);
    return ((hash * 0xC2B2AE3DU) >> 16U) % 5 < 2;
}

void time_graph(benchmark::State& state, const std::string& nodes, const Picture& picture) {
    MemoryGraph graph(nodes, picture, static_cast<int>(state.range(0)));
    graph.run();  // its memory is there from now on
    for (auto _ : state) graph.run();
    state.SetItemsProcessed(state.iterations() * picture.width * picture.height);
}

void add(const std::string& name, const std::string& nodes, const Picture& picture) {
    auto* b = benchmark::RegisterBenchmark(
        name.c_str(), [nodes, &picture](benchmark::State& state) { time_graph(state, nodes, picture); });
    b->ArgName("threads")->UseRealTime()->Unit(benchmark::kMillisecond);
    const auto cores = static_cast<int64_t>(std::thread::hardware_concurrency());
    for (int64_t threads = 1; threads < cores; threads *= 2) b->Arg(threads);
    b->Arg(cores);
}

void time_node(benchmark::State& state, const std::string& nodes, const Picture& picture) {
    TiledNode alone(nodes, picture);
    alone.run();
    for (auto _ : state) alone.run();
    state.SetItemsProcessed(state.iterations() * picture.width * picture.height);
}

void add_alone(const std::string& name, const std::string& nodes, const Picture& picture) {
    benchmark::RegisterBenchmark(
        name.c_str(), [nodes, &picture](benchmark::State& state) { time_node(state, nodes, picture); })
        ->ArgName("threads")
        ->Arg(1)
        ->UseRealTime()
        ->Unit(benchmark::kMillisecond);
}

// One node on picture "a"; `rest` is its other members.
std::string node(const std::string& type, const std::string& rest = "", const std::string& id = "result",
                 const std::string& in = "a") {
    return fmt::format(R"("{}": {{"type": "{}", "in": "{}"{}{}}})", id, type, in, rest.empty() ? "" : ", ",
                       rest);
}

void add_edge_nodes(const Picture& grey) {
    const std::string slope = node("gradient", "", "slope"),
                      edges = node("hysteresis", R"("low": 0.04, "high": 0.12)", "result", "thin");
    for (const char* sigma : {"1.4", "5", "20"})
        add(fmt::format("gaussian sigma {}", sigma), node("gaussian", fmt::format(R"("sigma": {})", sigma)),
            grey);
    add("gradient", node("gradient"), grey);
    add("gradient, nms", slope + ", " + node("nms", "", "result", "slope"), grey);
    add("hysteresis", node("hysteresis", R"("low": 0.4, "high": 0.6)"), grey);
    add("gaussian, gradient, nms, hysteresis",
        fmt::format("{}, {}, {}, {}", node("gaussian", R"("sigma": 1.4)", "smooth"),
                    node("gradient", "", "slope", "smooth"), node("nms", "", "thin", "slope"), edges),
        grey);
}

void add_hard_hysteresis(const std::string& name, Picture picture) {
    const auto shared = std::make_shared<Picture>(std::move(picture));
    benchmark::RegisterBenchmark(("hysteresis, " + name).c_str(),
                                 [shared](benchmark::State& state) {
                                     time_graph(state, node("hysteresis", R"("low": 0.4, "high": 0.6)"),
                                                *shared);
                                 })
        ->ArgName("threads")
        ->Arg(1)
        ->UseRealTime()
        ->Unit(benchmark::kMillisecond);
}

void add_dilations(const Pictures& pictures) {
    for (const char* shape : {"square", "disk", "diamond"})
        for (const int radius : {2, 50}) {
            const std::string nodes =
                node("dilate", fmt::format(R"("radius": {}, "shape": "{}")", radius, shape));
            add_alone(fmt::format("dilate {} {}", shape, radius), nodes, pictures.grey);
            add_alone(fmt::format("dilate {} {}, mask", shape, radius), nodes, pictures.mask);
        }
}

// Passes as strokes are made of: with the slope of the normals in place of them.
Picture with_slope(Picture passes) {
    MemoryGraph graph(node("gradient", R"("operator": "sobel")", "result", "a:Normal"), passes, 1);
    graph.run();
    for (std::size_t c = passes.channels.size(); c-- > 0;)
        if (passes.channels[c].starts_with("Normal.")) {
            passes.channels.erase(passes.channels.begin() + static_cast<std::ptrdiff_t>(c));
            passes.planes.erase(passes.planes.begin() + static_cast<std::ptrdiff_t>(c));
        }
    for (std::size_t c = 0; c < graph.result().channels.size(); ++c) {
        passes.channels.push_back("Slope." + graph.result().channels[c]);
        passes.planes.push_back(graph.result().planes[c]);
    }
    return passes;
}

// From passes to a drawing, on one thread.
void add_strokes(const Picture& passes) {
    const std::string nodes = R"(
        "objects": {"type": "contours", "in": "a", "layer": "CryptoObject", "depth": "a:Depth"},
        "creases": {"type": "trace", "in": "a:Slope", "low": 0.15, "high": 0.4, "owner": "a",
                    "layer": "CryptoObject", "except": "objects"},
        "lines": {"type": "chain", "in": ["objects", "creases"]},
        "calm": {"type": "smooth", "in": "lines"},
        "wide": {"type": "weight", "in": "calm", "width": 4},
        "result": {"type": "draw", "in": "wide"})";
    benchmark::RegisterBenchmark(
        "contours, trace, chain, smooth, weight, draw",
        [nodes, &passes](benchmark::State& state) { time_graph(state, nodes, passes); })
        ->ArgName("threads")
        ->Arg(1)
        ->UseRealTime()
        ->Unit(benchmark::kMillisecond);
}

void add_point_nodes(const Pictures& pictures) {
    add("over", R"("result": {"type": "over", "fg": "a", "bg": "b"})", pictures.beauty);
    add("grade", node("grade", R"("multiply": 1.5, "add": 0.1)"), pictures.beauty);
    add("grade with gamma", node("grade", R"("gamma": 2.2)"), pictures.beauty);
    add("six point nodes",
        fmt::format("{}, {}, {}, {}, {}, {}", node("math", R"("op": "multiply", "value": 2)", "n1"),
                    node("math", R"("op": "add", "value": 0.25)", "n2", "n1"),
                    node("math", R"("op": "min", "value": 1)", "n3", "n2"),
                    node("math", R"("op": "subtract", "value": 0.25)", "n4", "n3"),
                    node("math", R"("op": "max", "value": 0)", "n5", "n4"),
                    node("math", R"("op": "multiply", "value": 0.5)", "result", "n5")),
        pictures.grey);
}

int run(int argc, char** argv) {
    Pictures pictures;
    pictures.beauty = read_beauty(argv[1]);
    pictures.grey = grey_of(pictures.beauty);
    pictures.mask = mask_of(pictures.grey, 0.5F);
    pictures.passes = with_slope(read_passes(argv[1]));
    argv[1] = argv[0];
    --argc;
    ++argv;
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    add("copy", node("shuffle", R"("channels": {"Y": "Y"})"), pictures.grey);
    add_edge_nodes(pictures.grey);
    const int width = pictures.grey.width, height = pictures.grey.height;
    add_hard_hysteresis("nothing", weak_where(width, height, [](int, int) { return false; }));
    add_hard_hysteresis("one component", weak_where(width, height, [](int, int) { return true; }));
    add_hard_hysteresis("noise", weak_where(width, height, is_noise));
    add_hard_hysteresis(
        "a spiral", weak_where(width, height, [&](int x, int y) { return on_spiral(x, y, width, height); }));
    add_dilations(pictures);
    add_point_nodes(pictures);
    add_strokes(pictures.passes);
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}

}  // namespace
}  // namespace keyline::bench

int main(int argc, char** argv) {
    if (argc < 2) {
        std::cerr << "usage: bench_kernels PLATE.exr [options of Google Benchmark]\n";
        return 2;
    }
    try {
        return keyline::bench::run(argc, argv);
    } catch (const std::exception& e) {
        std::cerr << "error: " << e.what() << '\n';
        return 1;
    }
}
