// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/plan.h"

#include "cli/commands.h"
#include "cli/frames.h"
#include "cli/options.h"
#include "cli/report.h"

namespace keyline::cli {

namespace {

int run(const GraphArguments& arguments) {
    Diagnostics diagnostics;
    const LoadedGraph loaded = load_graph(arguments, diagnostics);
    std::string note;
    if (loaded.graph) {
        const std::vector<int> frames =
            frames_to_check(*loaded.graph, loaded.options.frames, note, diagnostics);
        if (!note.empty()) print_message("planned for " + note);
        for (const int frame : frames) {
            if (!diagnostics.ok()) break;
            const std::optional<Plan> plan = plan_frame(*loaded.graph, frame, loaded.options, diagnostics);
            if (plan) print_result(plan->text() + (frame == frames.back() ? "" : "\n"));
        }
    }
    report(diagnostics);
    return exit_status(diagnostics);
}

}  // namespace

void add_plan(CLI::App& program, Chosen& chosen) {
    CLI::App& command = *program.add_subcommand(
        "plan", "Tell what a render will do: windows, channels read, sweeps, tiles, memory");
    const auto arguments = std::make_shared<GraphArguments>();
    add_graph_options(command, *arguments);
    add_machine_options(command, *arguments);
    command.callback([&chosen, arguments] { chosen = [arguments] { return run(*arguments); }; });
}

}  // namespace keyline::cli
