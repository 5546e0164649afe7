// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/plan/plan.h"

#include "cli/common/frames.h"
#include "cli/common/options.h"
#include "cli/common/report.h"
#include "cli/graphs/commands.h"
#include "cli/graphs/plan_json.h"
#include "engine/plan/memory.h"

#include <fmt/format.h>

namespace keyline::cli {

namespace {

// What a plan has to do with, and what said so.
std::string limits_text(const LoadedGraph& loaded) {
    return fmt::format("\nlimits: {} thread{}: {}; {} of memory: {}\n", loaded.options.threads,
                       loaded.options.threads == 1 ? "" : "s", loaded.threads.by,
                       memory_text(loaded.options.memory), loaded.memory.by);
}

// Each with where it has its value from.
std::string variables_text(const Graph& graph) {
    std::string out;
    for (const auto& [name, value] : graph.variables().given())
        out += fmt::format("  {} = {}, from {}\n", name, value.shown(), value.place.text());
    return out.empty() ? "" : "\nvariables:\n" + out;
}

int run(const GraphArguments& arguments, bool as_json) {
    Diagnostics diagnostics;
    JsonWriter json(JsonWriter::Style::kIndented);
    json.begin_array();
    const LoadedGraph loaded = load_graph(arguments, diagnostics);
    std::string note;
    if (loaded.graph) {
        const std::vector<int> frames = frames_to_check(*loaded.graph, loaded.options.frames, note);
        if (!note.empty()) print_message("planned for " + note);
        check_frames(*loaded.graph, frames, loaded.options, diagnostics);
        const auto tell = [&](const Plan& plan) {
            if (as_json) return write_plan(json, plan);
            print_result(plan.text() + (plan.frame.frame == frames.back() ? "" : "\n"));
        };
        Diagnostics of_plans;  // warnings were told
        if (diagnostics.ok()) plan_frames(*loaded.graph, frames, loaded.options, of_plans, tell);
        for (const Error& e : of_plans.errors()) diagnostics.error(e);
        if (diagnostics.ok() && !as_json) print_result(variables_text(*loaded.graph) + limits_text(loaded));
    }
    if (as_json) print_result(json.end_array().text() + "\n");
    report(diagnostics);
    return exit_status(diagnostics);
}

}  // namespace

void add_plan(const Command& program) {
    const Command command =
        program.add("plan", "Tell what a render will do: windows, channels read, sweeps, tiles, memory");
    const auto arguments = std::make_shared<GraphArguments>();
    add_graph_options(command, *arguments);
    add_machine_options(command, *arguments);
    const auto as_json = std::make_shared<bool>(false);
    command.flag("--json", *as_json, "As JSON: a list with an object a frame");
    command.runs([arguments, as_json] { return run(*arguments, *as_json); });
}

}  // namespace keyline::cli
