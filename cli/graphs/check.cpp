// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/common/frames.h"
#include "cli/common/options.h"
#include "cli/common/report.h"
#include "cli/graphs/commands.h"
#include "cli/graphs/disk_space.h"
#include "cli/graphs/frame_changes.h"
#include "cli/graphs/messages.h"
#include "cli/graphs/streams.h"
#include "engine/base/text.h"
#include "engine/graph/read_text.h"
#include "engine/json/json_reader.h"
#include "engine/params/frames.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace keyline::cli {

namespace {

namespace fs = std::filesystem;

std::string counted(std::size_t n, const char* what) {
    return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

struct CheckArguments {
    std::vector<std::string> graphs;
    GraphArguments of_each;
    bool streams = false, json = false, sarif = false;

    bool for_programs() const { return sarif || (json && !streams); }
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

// Finds out about one graph; what is right with it is returned as text.
std::string check_graph(const CheckArguments& all, const GraphArguments& arguments,
                        Diagnostics& diagnostics) {
    const LoadedGraph loaded = load_graph(arguments, diagnostics);
    std::vector<int> frames;
    std::optional<Streams> streams;
    std::string note;
    if (loaded.graph) {
        frames = frames_to_check(*loaded.graph, loaded.options.frames, note);
        if (arguments.frames == kAllFrames) warn_of_gaps(frames, diagnostics);
        if (all.streams) streams.emplace(all.json, *loaded.graph);
        FrameChanges changes(*loaded.graph);
        DiskSpace space;
        check_frames(*loaded.graph, frames, loaded.options, diagnostics, [&](const ResolvedFrame& frame) {
            changes.look(frame, diagnostics);
            space.look(frame);
            if (streams) streams->add(frame);
        });
        space.tell(diagnostics);
    }
    if (!note.empty() && !all.for_programs()) print_message("checked with " + note);
    diagnostics.sort_by_place();
    if (!diagnostics.ok()) return "";
    return streams ? streams->text() : verdict(arguments.graph, *loaded.graph, frames);
}

// A graph: JSON with nodes of its own.  A group has `outputs` too and is looked at where it is used.
bool is_graph(const fs::path& file) {
    try {
        const Value root = parse_json(read_text(file, "the graph"), file.string());
        return root.find("keyline") && root.find("nodes") && !root.find("outputs");
    } catch (const Failure&) {
        return true;  // what is wrong with it is told when it is checked
    }
}

// The graphs that a name stands for: the file, or those in a folder and below it.
std::vector<std::string> graphs_of(const std::string& name) {
    std::error_code error;
    if (!fs::is_directory(name, error)) return {name};
    std::vector<std::string> out;
    for (const auto& entry : fs::recursive_directory_iterator(name, error))
        if (entry.path().extension() == ".json" && is_graph(entry.path()))
            out.push_back(entry.path().string());
    if (out.empty())
        fail(ErrorKind::kGraph, fmt::format("{}: there is no graph in this folder", escaped(name)),
             "graphs are files .json with \"keyline\" and \"nodes\"");
    std::ranges::sort(out);
    return out;
}

std::vector<std::string> all_graphs(const std::vector<std::string>& names) {
    std::vector<std::string> out;
    for (const std::string& name : names)
        for (std::string& graph : graphs_of(name)) out.push_back(std::move(graph));
    return out;
}

// A graph that is wrong keeps no other from being checked.
int run(const CheckArguments& arguments) {
    std::vector<CheckedGraph> checked;
    Diagnostics all;
    for (const std::string& graph : all_graphs(arguments.graphs)) {
        GraphArguments one = arguments.of_each;
        one.graph = graph;
        CheckedGraph& now = checked.emplace_back();
        now.file = graph;
        const std::string result = check_graph(arguments, one, now.diagnostics);
        for (const Error& e : now.diagnostics.errors()) all.error(e);
        if (arguments.for_programs()) continue;
        report(now.diagnostics);
        print_result(result);
    }
    if (arguments.for_programs())
        print_result(arguments.sarif ? messages_sarif(checked) : messages_json(checked));
    return exit_status(all);
}

}  // namespace

void add_check(const Command& program) {
    const Command command = program.add("check", "Tell every error of graphs without computing a pixel");
    const auto arguments = std::make_shared<CheckArguments>();
    command.argument("GRAPH", arguments->graphs, "Graph files, or folders of them; - for standard input");
    add_graph_value_options(command, arguments->of_each);
    command.flag("--streams", arguments->streams,
                 "Show what each node makes: windows, channels, types and digests");
    const Option json = command.flag(
        "--json", arguments->json,
        "What is wrong, as JSON: a list with an object a graph; with --streams, an object a frame");
    command.flag("--sarif", arguments->sarif, "What is wrong, as code review reads it: SARIF 2.1.0")
        .excludes(json);
    command.runs([arguments] { return run(*arguments); });
}

}  // namespace keyline::cli
