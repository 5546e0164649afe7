// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/common/frames.h"
#include "cli/common/options.h"
#include "cli/common/report.h"
#include "cli/graphs/commands.h"
#include "cli/graphs/streams.h"
#include "engine/params/frames.h"

#include <fmt/format.h>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace keyline::cli {

namespace {

std::string counted(std::size_t n, const char* what) {
    return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

struct CheckArguments {
    std::vector<std::string> graphs;
    GraphArguments of_each;
    bool streams = false, json = false;
};

// What every node makes, frame by frame.
class Streams {
public:
    Streams(bool as_json, const Graph& graph) : as_json_(as_json), graph_(graph) { json_.begin_array(); }
    void add(const ResolvedFrame& frame) {
        if (as_json_) return write_streams(json_, graph_, frame);
        text_ += (text_.empty() ? "" : "\n") + streams_text(graph_, frame);
    }
    std::string text() { return as_json_ ? json_.end_array().text() + "\n" : text_; }

private:
    bool as_json_;
    const Graph& graph_;
    JsonWriter json_{JsonWriter::Style::kIndented};
    std::string text_;
};

std::string verdict(const std::string& file, const Graph& graph, const std::vector<int>& frames) {
    return fmt::format("{}: ok: {}, {}, {}\n", file, counted(graph.nodes().size(), "node"),
                       counted(graph.sinks().size(), "output"),
                       frames.size() == 1 ? fmt::format("frame {}", frames[0])
                                          : fmt::format("frames {}", format_frames(frames)));
}

// Tells of one graph; its faults are left in `diagnostics`.
void check_graph(const CheckArguments& all, const GraphArguments& arguments, Diagnostics& diagnostics) {
    const LoadedGraph loaded = load_graph(arguments, diagnostics);
    if (all.json && !all.streams)
        diagnostics.error({ErrorKind::kGraph, {"--json", 0, 0}, {}, "it tells of --streams; give both", {}});
    std::vector<int> frames;
    std::optional<Streams> streams;
    std::string note;
    if (loaded.graph) {
        frames = frames_to_check(*loaded.graph, loaded.options.frames, note);
        if (all.streams) streams.emplace(all.json, *loaded.graph);
        check_frames(*loaded.graph, frames, loaded.options, diagnostics, [&](const ResolvedFrame& frame) {
            if (streams) streams->add(frame);
        });
    }
    if (!note.empty()) print_message("checked with " + note);
    diagnostics.sort_by_place();
    report(diagnostics);
    if (diagnostics.ok())
        print_result(streams ? streams->text() : verdict(arguments.graph, *loaded.graph, frames));
}

// A graph that is wrong keeps no other from being checked.
int run(const CheckArguments& arguments) {
    Diagnostics all;
    for (const std::string& graph : arguments.graphs) {
        GraphArguments one = arguments.of_each;
        one.graph = graph;
        Diagnostics diagnostics;
        check_graph(arguments, one, diagnostics);
        for (const Error& e : diagnostics.errors()) all.error(e);
    }
    return exit_status(all);
}

}  // namespace

void add_check(const Command& program) {
    const Command command = program.add("check", "Tell every error of graphs without computing a pixel");
    const auto arguments = std::make_shared<CheckArguments>();
    command.argument("GRAPH", arguments->graphs, "Graph files; - for standard input");
    add_graph_value_options(command, arguments->of_each);
    command.flag("--streams", arguments->streams,
                 "Show what each node makes: windows, channels, types and digests");
    command.flag("--json", arguments->json, "With --streams, as JSON: a list with an object a frame");
    command.runs([arguments] { return run(*arguments); });
}

}  // namespace keyline::cli
