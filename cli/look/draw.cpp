// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/common/frames.h"
#include "cli/common/report.h"
#include "cli/common/temporary_folder.h"
#include "cli/look/commands.h"
#include "cli/look/diagram.h"
#include "cli/look/pictures.h"

#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <memory>

namespace keyline::cli {

namespace {

struct DrawArguments {
    GraphArguments graph;
    std::string file;
    bool no_pictures = false;
};

// All that is wrong with a frame, which is returned: the first of --frames, or of those there are.
int check_one_frame(const GraphArguments& arguments, Diagnostics& diagnostics) {
    const LoadedGraph loaded = load_graph(arguments, diagnostics);
    if (!loaded.graph) return 1;
    std::string unheard;
    const int frame = frames_to_check(*loaded.graph, loaded.options.frames, unheard).front();
    check_frames(*loaded.graph, {frame}, loaded.options, diagnostics);
    return frame;
}

// What is wrong, by node.
std::map<std::string, std::vector<std::string>> faults_of(const Graph& graph,
                                                          const Diagnostics& diagnostics) {
    std::map<std::string, std::vector<std::string>> out;
    for (const Error& e : diagnostics.errors())
        for (const GraphNode& node : graph.nodes())
            if (!e.node.empty() && e.node.starts_with(node.title())) out[node.id].push_back(e.what);
    return out;
}

struct Thumbnails {
    std::map<std::string, std::string> files;  // by node
    int status = 0;                            // of the run that makes them; where it fails there are none
};

Thumbnails make_thumbnails(const DrawArguments& arguments, const Graph& graph,
                           const TemporaryFolder& folder) {
    constexpr int kWidth = 160, kHeight = 90;
    PictureNodes added(graph, {});
    GraphArguments all = arguments.graph;
    Thumbnails out;
    for (const std::string& node : nodes_to_show(graph)) {
        const std::string file = folder / fmt::format("{}.png", out.files.size());
        all.only.push_back(added.write(added.show_small(node, kWidth, kHeight), file));
        out.files[node] = file;
    }
    all.added = added.text();
    out.status = render_pictures(all);
    if (out.status != 0) out.files.clear();
    return out;
}

void write_file(const std::string& file, const std::string& text) {
    std::ofstream out(file, std::ios::binary);
    out << text;
    out.close();
    if (!out) fail(ErrorKind::kOutput, fmt::format("{}: can't be written", file));
}

// A graph with faults is drawn too, with them in red; the status is theirs.
int run(const DrawArguments& arguments) {
    if (arguments.graph.graph == "-")
        fail(ErrorKind::kGraph, "the graph is read twice, which standard input can't be",
             "give it as a file");
    if (!arguments.file.ends_with(".svg"))
        throw Failure(
            {ErrorKind::kGraph, {"-o " + arguments.file, 0, 0}, {}, "a drawing is a file .svg", {}});
    refuse_outputs(arguments.graph);
    Diagnostics diagnostics;
    Diagram diagram;
    diagram.frame = check_one_frame(arguments.graph, diagnostics);
    report(diagnostics);
    const std::unique_ptr<const Graph> graph = load_quietly(arguments.graph);
    if (!graph) return exit_status(diagnostics);
    const TemporaryFolder folder;
    Thumbnails thumbnails;
    if (diagnostics.ok() && !arguments.no_pictures) thumbnails = make_thumbnails(arguments, *graph, folder);
    diagram.thumbnails = thumbnails.files;
    diagram.faults = faults_of(*graph, diagnostics);
    write_file(arguments.file, svg_of(dot_text(*graph, diagram), diagram));
    return diagnostics.ok() ? thumbnails.status : exit_status(diagnostics);
}

}  // namespace

void add_draw(const Command& program) {
    const Command command = program.add(
        "draw", "Draw the graph itself: its nodes with what they make, laid out from left to right");
    const auto arguments = std::make_shared<DrawArguments>();
    command.argument("GRAPH", arguments->graph.graph, "The graph file");
    command.option("-o,--drawing", arguments->file, "FILE", "The drawing, a file .svg").required();
    command.flag("--no-pictures", arguments->no_pictures, "Without pictures of what the nodes make");
    add_graph_value_options(command, arguments->graph);
    add_machine_options(command, arguments->graph);
    command.runs([arguments] { return run(*arguments); });
}

}  // namespace keyline::cli
