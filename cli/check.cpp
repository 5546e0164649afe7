// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/commands.h"
#include "cli/frames.h"
#include "cli/options.h"
#include "cli/report.h"
#include "engine/frames.h"

#include <fmt/format.h>
#include <set>

namespace keyline::cli {

namespace {

// What several frames have in common is told once.
class Findings {
public:
    explicit Findings(Diagnostics& all) : all_(all) {}
    void add(const Diagnostics& of_frame) {
        for (const Error& w : of_frame.warnings())
            if (seen_.insert(w.warning_text()).second) all_.warning(w);
        for (const Error& e : of_frame.errors())
            if (seen_.insert(e.text()).second) all_.error(e);
    }

private:
    Diagnostics& all_;
    std::set<std::string> seen_;
};

std::string counted(std::size_t n, const char* what) {
    return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

int run(const GraphArguments& arguments) {
    Diagnostics diagnostics;
    const LoadedGraph loaded = load_graph(arguments, diagnostics);
    std::vector<int> frames;
    std::string note;
    if (loaded.graph) {
        frames = frames_to_check(*loaded.graph, loaded.options.frames, note, diagnostics);
        Findings findings(diagnostics);
        for (const int frame : frames) {
            Diagnostics of_frame;
            check(*loaded.graph, frame, loaded.options, of_frame);
            findings.add(of_frame);
        }
    }
    if (!note.empty()) print_message("checked with " + note);
    diagnostics.sort_by_place();
    report(diagnostics);
    if (diagnostics.ok())
        print_result(fmt::format("{}: ok: {}, {}, {}\n", arguments.graph,
                                 counted(loaded.graph->nodes().size(), "node"),
                                 counted(loaded.graph->sinks().size(), "output"),
                                 frames.size() == 1 ? fmt::format("frame {}", frames[0])
                                                    : fmt::format("frames {}", format_frames(frames))));
    return exit_status(diagnostics);
}

}  // namespace

void add_check(CLI::App& program, Chosen& chosen) {
    CLI::App& command =
        *program.add_subcommand("check", "Tell every error of a graph without computing a pixel");
    const auto arguments = std::make_shared<GraphArguments>();
    add_graph_options(command, *arguments);
    command.callback([&chosen, arguments] { chosen = [arguments] { return run(*arguments); }; });
}

}  // namespace keyline::cli
