// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/common/frames.h"
#include "cli/common/report.h"
#include "cli/common/temporary_folder.h"
#include "cli/look/commands.h"
#include "cli/look/diagram.h"
#include "cli/look/page.h"
#include "cli/look/pictures.h"
#include "engine/base/channels.h"
#include "engine/base/index.h"

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

    bool is_page() const { return file.ends_with(".html"); }
};

using Facts = std::vector<std::pair<std::string, std::string>>;

// What `check` finds out about one frame.
struct Checked {
    int frame = 1;                       // the first of --frames, or of those there are
    std::map<std::string, Facts> facts;  // of what leaves a node
};

Facts facts_of(const Stream& stream) {
    if (stream.is_data()) return {{"gives", stream.data}, {"display window", to_string(stream.display)}};
    const std::vector<std::string> names = stream.names();
    std::string channels;
    for (const std::size_t i : rgba_order(names)) channels += (channels.empty() ? "" : "  ") + names[i];
    return {{"display window", to_string(stream.display)},
            {"data window", to_string(stream.window)},
            {"channels", channels}};
}

Checked check_one_frame(const GraphArguments& arguments, Diagnostics& diagnostics) {
    const LoadedGraph loaded = load_graph(arguments, diagnostics);
    Checked out;
    if (!loaded.graph) return out;
    std::string unheard;
    out.frame = frames_to_check(*loaded.graph, loaded.options.frames, unheard).front();
    check_frames(*loaded.graph, {out.frame}, loaded.options, diagnostics, [&](const ResolvedFrame& frame) {
        for (const NodeStream& s : frame.streams)
            out.facts[loaded.graph->nodes()[index(s.node)].id] = facts_of(s.stream);
    });
    return out;
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

// What one run makes of the nodes, in files by node; where it fails there are none.
struct Made {
    std::map<std::string, std::string> thumbnails, pictures, samples;
    int status = 0;
};

Made make_pictures(const DrawArguments& arguments, const Graph& graph, const TemporaryFolder& folder) {
    constexpr int kWidth = 160, kHeight = 90;
    PictureNodes added(graph, {});
    GraphArguments all = arguments.graph;
    Made out;
    for (const std::string& node : nodes_to_show(graph)) {
        const auto file = [&](const char* kind) {
            return folder / fmt::format("{}{}", out.thumbnails.size(), kind);
        };
        const std::string small = file(".png"), large = file(".jpg"), samples = file(".exr");
        all.only.push_back(added.write(added.show_small(node, kWidth, kHeight), small));
        out.thumbnails[node] = small;
        if (!arguments.is_page()) continue;
        all.only.push_back(added.write(added.show(node), large));
        out.pictures[node] = large;
        if (!graph.nodes()[index(graph.index_of(node))].type->gives.empty()) continue;
        all.only.push_back(added.write_samples(node, samples));
        out.samples[node] = samples;
    }
    all.added = added.text();
    out.status = render_pictures(all);
    return out.status == 0 ? out : Made{{}, {}, {}, out.status};
}

PageNode page_node(const Graph& graph, int node, const Checked& checked, const Made& made) {
    const GraphNode& n = graph.nodes()[index(node)];
    PageNode out{node, n.id, n.type->name, n.type->help, {}, {}, {}, {}};
    for (const Member& m : n.object.members) out.parameters.emplace_back(m.key, m.value.shown());
    if (const auto it = checked.facts.find(n.id); it != checked.facts.end()) out.facts = it->second;
    if (const auto it = made.pictures.find(n.id); it != made.pictures.end()) out.picture = it->second;
    if (const auto it = made.samples.find(n.id); it != made.samples.end())
        out.statistics = statistics_of(*open_image(it->second));
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
    if (!arguments.file.ends_with(".svg") && !arguments.is_page())
        throw Failure({ErrorKind::kGraph,
                       {"-o " + arguments.file, 0, 0},
                       {},
                       "a drawing is a file .svg, or a page .html",
                       {}});
    refuse_outputs(arguments.graph);
    Diagnostics diagnostics;
    const Checked checked = check_one_frame(arguments.graph, diagnostics);
    report(diagnostics);
    const std::unique_ptr<const Graph> graph = load_quietly(arguments.graph);
    if (!graph) return exit_status(diagnostics);
    const TemporaryFolder folder;
    Made made;
    if (diagnostics.ok() && !arguments.no_pictures) made = make_pictures(arguments, *graph, folder);
    const Diagram diagram{made.thumbnails, faults_of(*graph, diagnostics), checked.frame};
    const std::string svg = svg_of(dot_text(*graph, diagram), diagram);
    std::vector<PageNode> nodes;
    if (arguments.is_page())
        for (const int node : graph->order()) nodes.push_back(page_node(*graph, node, checked, made));
    write_file(arguments.file, arguments.is_page() ? page_of(arguments.graph.graph, svg, nodes) : svg);
    return diagnostics.ok() ? made.status : exit_status(diagnostics);
}

}  // namespace

void add_draw(const Command& program) {
    const Command command = program.add(
        "draw", "Draw the graph itself: its nodes with what they make, laid out from left to right");
    const auto arguments = std::make_shared<DrawArguments>();
    command.argument("GRAPH", arguments->graph.graph, "The graph file");
    command
        .option("-o,--drawing", arguments->file, "FILE",
                "The drawing: a file .svg, or a page .html where a click tells of a node")
        .required();
    command.flag("--no-pictures", arguments->no_pictures, "Without pictures of what the nodes make");
    add_graph_value_options(command, arguments->graph);
    add_machine_options(command, arguments->graph);
    command.runs([arguments] { return run(*arguments); });
}

}  // namespace keyline::cli
