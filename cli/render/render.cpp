// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/common/frames.h"
#include "cli/common/options.h"
#include "cli/common/report.h"
#include "cli/common/signals.h"
#include "cli/render/commands.h"
#include "cli/render/progress.h"
#include "cli/render/run_report.h"
#include "engine/run/one_tile.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <fmt/format.h>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <sys/resource.h>
#include <utility>

namespace keyline::cli {

namespace {

struct RenderArguments {
    GraphArguments graph;
    std::string progress = "auto", heartbeat, wait_inputs;
    bool skip_existing = false, only_stale = false, keep_going = false, no_provenance = false;
    std::string profile;  // the trace's file; empty: none
    std::string report;   // its file; empty: none
    std::string only_tile;
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

void start_no_more_threads_than_there_can_be(RenderOptions& options, Progress& progress) {
    const int startable = startable_threads(options.threads);
    if (startable == options.threads) return;
    progress.warning(
        {ErrorKind::kFailed,
         {},
         {},
         fmt::format("the system lets this process start {} of {} threads; the render goes on with {}",
                     startable - 1, options.threads - 1, startable == 1 ? "one" : "those"),
         "see ulimit -u, and the limits of the control group"});
    options.threads = startable;
}

// Where the name is wrong, errors are told all the same.
std::unique_ptr<Voice> voice_of(const std::string& name, Diagnostics& diagnostics) {
    try {
        return voice_named(name);
    } catch (const Failure& f) {
        Error e = f.error();
        e.place = {"--progress " + name, 0, 0};
        diagnostics.error(std::move(e));
        return voice_named("none");
    }
}

// Nothing where it is not given.
std::optional<std::chrono::milliseconds> patience_of(const std::string& text, Diagnostics& diagnostics) {
    if (text.empty()) return std::nullopt;
    double seconds = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seconds);
    if (error == std::errc() && end == text.data() + text.size() && seconds >= 0.01 && seconds <= 86400)
        return std::chrono::milliseconds(static_cast<int>(1000 * seconds));
    diagnostics.error({ErrorKind::kGraph,
                       {"--heartbeat " + text, 0, 0},
                       {},
                       "it must be a number of seconds from 0.01 to 86400",
                       {}});
    return std::nullopt;
}

// Reads an option where it is given; what is wrong with it is told.
template <class Read>
void read_option(const char* name, const std::string& text, Diagnostics& diagnostics, const Read& read) {
    try {
        if (!text.empty()) read(text);
    } catch (const Failure& f) {
        Error e = f.error();
        e.place = {fmt::format("{} {}", name, text), 0, 0};
        diagnostics.error(std::move(e));
    }
}

// "edges@0,64,32,32"
OneTile parse_tile(const std::string& text) {
    const std::size_t at = text.rfind('@');
    std::vector<int> numbers;
    for (std::size_t begin = at; begin < text.size();) {
        const std::size_t end = std::min(text.find(',', begin + 1), text.size());
        numbers.push_back(parse_count(text.substr(begin + 1, end - begin - 1),
                                      numbers.size() < 2 ? -kMaxCoordinate : 1, kMaxCoordinate));
        begin = end;
    }
    if (at == 0 || at == std::string::npos || numbers.size() != 4)
        fail(ErrorKind::kGraph, "it must be NODE@X,Y,WIDTH,HEIGHT");
    return {
        text.substr(0, at), 1, {numbers[0], numbers[1], numbers[0] + numbers[2], numbers[1] + numbers[3]}};
}

// What an internal error asks for: a region of a node by itself.  Nothing is written.
int run_one_tile(const RenderArguments& arguments) {
    Diagnostics diagnostics;
    const LoadedGraph loaded = load_graph(arguments.graph, diagnostics);
    if (loaded.graph) {
        try {
            OneTile tile = parse_tile(arguments.only_tile);
            if (!loaded.options.frames.empty()) tile.frame = loaded.options.frames.front();
            const auto channels = render_one_tile(*loaded.graph, tile, loaded.options, diagnostics);
            if (diagnostics.ok())
                print_result(
                    fmt::format("{}, frame {}: {}\n", tile.node, tile.frame, to_string(tile.region)));
            for (const TileChannel& c : channels)
                print_result(fmt::format("  {}: {} from {} to {}, {} not finite\n", c.name,
                                         to_string(c.samples), c.least, c.most, c.not_finite));
        } catch (const Failure& f) {
            Error e = f.error();
            if (e.kind == ErrorKind::kGraph) e.place = {"--only-tile " + arguments.only_tile, 0, 0};
            diagnostics.error(std::move(e));
        }
    }
    report(diagnostics);
    return exit_status(diagnostics);
}

struct Ended {
    Ending ending;
    std::vector<int> untried;  // frames
};

Ended render_frames(const LoadedGraph& loaded, Recorder* recorder, Progress& progress, Reporter* reporter) {
    const StopOnSignal stop;
    progress.start();
    try {
        RenderObserver& listener = reporter ? static_cast<RenderObserver&>(*reporter) : progress;
        const RenderResult result = render(*loaded.graph, loaded.options, listener, stop.requested());
        if (recorder) end_profile(*recorder);
        return {ending_of(result.cause), result.untried};
    } catch (const Failure& f) {
        if (recorder) recorder->finish();
        if (f.error().kind != ErrorKind::kCancelled) throw;
        progress.stopped(stop.signal_name());
        return {{stop.exit_status(), true, "stopped"}, {}};
    }
}

Ended load_and_render(const RenderArguments& arguments, Progress& progress, Diagnostics& diagnostics) {
    const auto patience = patience_of(arguments.heartbeat, diagnostics);
    LoadedGraph loaded = load_graph(arguments.graph, diagnostics);
    RenderOptions& options = loaded.options;
    options.skip_existing = arguments.skip_existing;
    options.only_stale = arguments.only_stale;
    options.provenance = !arguments.no_provenance;
    options.keep_going = arguments.keep_going;
    read_option("--wait-inputs", arguments.wait_inputs, diagnostics,
                [&](const std::string& s) { options.wait_inputs = parse_duration(s); });
    read_option("--report", arguments.report, diagnostics, check_report_name);
    if (loaded.graph && !loaded.no_frames)
        options.frames = frames_to_render(*loaded.graph, options.frames, diagnostics);
    progress.expect(options.frames);
    tell(diagnostics, progress);
    if (!diagnostics.ok()) return {ending_of(decisive(diagnostics.errors())), {}};

    if (loaded.no_frames) return {};
    progress.keep_talking(patience);
    start_no_more_threads_than_there_can_be(options, progress);
    std::optional<Recorder> recorder;
    if (!arguments.profile.empty()) options.recorder = &recorder.emplace(arguments.profile);
    if (arguments.report.empty()) return render_frames(loaded, options.recorder, progress, nullptr);
    Reporter reporter(progress, arguments.graph.graph, options.frames);
    Ended ended = render_frames(loaded, options.recorder, progress, &reporter);
    write_report(reporter.finish(*loaded.graph, options, ended.ending), arguments.report);
    return ended;
}

int run(const RenderArguments& arguments) {
    if (!arguments.only_tile.empty()) return run_one_tile(arguments);
    Diagnostics diagnostics;
    Progress progress(voice_of(arguments.progress, diagnostics));
    Ended ended;
    try {
        ended = load_and_render(arguments, progress, diagnostics);
    } catch (...) {
        const Error error = error_of(std::current_exception());
        progress.error(error);
        ended.ending = ending_of(error);
    }
    progress.end(ended.ending, ended.untried);
    return ended.ending.status;
}

}  // namespace

void add_render(const Command& program) {
    const Command command = program.add("render", "Render frames of a graph");
    const auto arguments = std::make_shared<RenderArguments>();
    add_graph_options(command, arguments->graph);
    add_machine_options(command, arguments->graph);
    command.flag("--skip-existing", arguments->skip_existing,
                 "Leave finished outputs alone: those that open and have the planned windows and channels");
    command.flag("--stale", arguments->only_stale, "Make only what 'keyline verify' finds not to be current");
    command.flag("--no-provenance", arguments->no_provenance,
                 "Leave out of the outputs what they were made of: equal pixels are equal files");
    command.flag("--keep-going", arguments->keep_going, "Go on with the next frame after one fails");
    command.option(
        "--wait-inputs", arguments->wait_inputs, "TIME",
        "Have a frame wait so long for inputs that are not there yet or not whole, as 10m; not at all "
        "when absent");
    command.option("--report", arguments->report, "FILE",
                   "Write what became of each frame to FILE, .json or .html; reads the outputs once more");
    command.option("--profile", arguments->profile, "FILE",
                   "Print where the time went and write it to FILE as a Chrome trace");
    command.option(
        "--progress", arguments->progress,
        "auto|bar|lines|json|none|openjd|afanasy|tractor|deadline|flamenco",
        "How to say how far it is; auto is what the render farm's manager reads where it is recognised, "
        "else a bar on a terminal, else lines");
    command.option(
        "--heartbeat", arguments->heartbeat, "SECONDS",
        "Say at least so often how far a frame is; 30 when absent, 10 for openjd, afanasy, tractor and "
        "deadline");
    command
        .option("--only-tile", arguments->only_tile, "NODE@X,Y,WIDTH,HEIGHT",
                "Compute this alone, on one thread, and write nothing")
        .hidden();  // not listed: an internal error names it
    command.runs([arguments] { return run(*arguments); });
}

}  // namespace keyline::cli
