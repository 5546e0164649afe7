// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/render.h"

#include "cli/commands.h"
#include "cli/frames.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "cli/report.h"
#include "cli/signals.h"

#include <csignal>
#include <fmt/format.h>
#include <fstream>
#include <iostream>
#include <map>
#include <optional>
#include <sys/resource.h>
#include <utility>

namespace keyline::cli {

namespace {

struct RenderArguments {
    GraphArguments graph;
    std::string progress = "auto";
    bool skip_existing = false, keep_going = false;
    std::string profile;  // the trace's file; empty: none
};

// What the process read from files and wrote to them so far, as Linux counts it; 0 where it does not.
std::pair<double, double> megabytes_moved() {
    std::ifstream io("/proc/self/io");
    std::map<std::string, double> counts;
    std::string name;
    for (double bytes = 0; io >> name >> bytes;) counts[name] = bytes / (1 << 20);
    return {counts["rchar:"], counts["wchar:"]};
}

// Where the time went: the trace's end, and a table on standard output.
void end_profile(Recorder& recorder) {
    recorder.finish();
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto [read, written] = megabytes_moved();
    std::cout << recorder.table()
              << fmt::format("{:9.1f}  MiB read from files, {:.1f} MiB written, this trace too\n", read,
                             written)
              << fmt::format("{:9}  MiB of memory at most\n", usage.ru_maxrss >> 10);
}

void tell(const Diagnostics& diagnostics, Progress& progress) {
    for (const Error& w : diagnostics.warnings()) progress.warning(w);
    for (const Error& e : diagnostics.errors()) progress.error(e);
}

ProgressMode progress_mode(const std::string& word, Diagnostics& diagnostics) {
    try {
        return parse_progress(word);
    } catch (const Failure& f) {
        Error e = f.error();
        e.place = {"--progress " + word, 0, 0};
        diagnostics.error(std::move(e));
        return ProgressMode::kNone;
    }
}

int run(const RenderArguments& arguments) {
    Diagnostics diagnostics;
    Progress progress(progress_mode(arguments.progress, diagnostics));
    LoadedGraph loaded = load_graph(arguments.graph, diagnostics);
    RenderOptions& options = loaded.options;
    options.skip_existing = arguments.skip_existing;
    options.keep_going = arguments.keep_going;
    if (loaded.graph) options.frames = frames_to_render(*loaded.graph, options.frames, diagnostics);
    tell(diagnostics, progress);
    if (!diagnostics.ok()) return exit_status(diagnostics);

    std::optional<Recorder> recorder;
    if (!arguments.profile.empty()) options.recorder = &recorder.emplace(arguments.profile);
    const StopOnSignal stop;
    progress.start(options.frames.size());
    try {
        const RenderResult result = render(*loaded.graph, options, progress, stop.requested());
        progress.end();
        if (recorder) end_profile(*recorder);
        return result.status;
    } catch (const Failure& f) {
        progress.end();
        if (recorder) recorder->finish();
        if (f.error().kind != ErrorKind::kCancelled) throw;
        progress.stopped(stop.signal() == SIGTERM ? "SIGTERM" : "SIGINT");
        return stop.exit_status();
    }
}

}  // namespace

void add_render(CLI::App& program, Chosen& chosen) {
    CLI::App& command = *program.add_subcommand("render", "Render frames of a graph");
    const auto arguments = std::make_shared<RenderArguments>();
    add_graph_options(command, arguments->graph);
    add_machine_options(command, arguments->graph);
    command.add_flag(
        "--skip-existing", arguments->skip_existing,
        "Leave finished outputs alone: those that open and have the planned windows and channels");
    command.add_flag("--keep-going", arguments->keep_going, "Go on with the next frame after one fails");
    add_value_option(command, "--profile", arguments->profile, "FILE",
                     "Print where the time went and write it to FILE as a Chrome trace");
    add_value_option(command, "--progress", arguments->progress, "MODE",
                     "auto (a bar on a terminal, lines elsewhere), bar, lines, json or none");
    command.callback([&chosen, arguments] { chosen = [arguments] { return run(*arguments); }; });
}

}  // namespace keyline::cli
