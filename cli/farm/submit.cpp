// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/farm/submit.h"

#include "cli/common/frames.h"
#include "cli/common/report.h"
#include "cli/common/run_program.h"
#include "cli/farm/commands.h"
#include "cli/farm/job_files.h"
#include "engine/params/frames.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <random>

namespace keyline::cli {

namespace {

constexpr int kMostFramesOfATask = 1'000'000;
constexpr std::size_t kBeside = std::size_t{64} << 20;  // bytes, for the script and the libraries

struct SubmitArguments {
    GraphArguments graph;
    std::string chunk = "10", name, logs = ".", partition, round = "1", rounds = "3";
    bool print = false, wait = false;
    std::string bundle;  // of Open Job Description
    std::string files;   // the folder to write a job's files into; empty: they are sent
    std::string program;
    Submission own;  // what its manager alone asks for
};

std::vector<std::string> chunks_of(const std::vector<int>& frames, int chunk) {
    std::vector<std::string> out;
    const auto n = static_cast<std::size_t>(chunk);
    for (std::size_t i = 0; i < frames.size(); i += n) {
        const auto first = frames.begin() + static_cast<std::ptrdiff_t>(i);
        out.push_back(
            format_frames({first, first + static_cast<std::ptrdiff_t>(std::min(n, frames.size() - i))}));
        std::erase(out.back(), ' ');
    }
    return out;
}

// What tells jobs of the same graph apart.
std::string name_of(const GraphArguments& graph) {
    std::string stem = std::filesystem::path(graph.graph).stem().string();
    std::ranges::replace_if(
        stem, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
    return fmt::format("keyline-{}-{:06x}", stem, std::random_device()() & 0xFFFFFFU);
}

void add_folder(std::vector<std::string>& folders, const std::filesystem::path& file) {
    const std::string folder = std::filesystem::absolute(file).parent_path().string();
    if (std::ranges::find(folders, folder) == folders.end()) folders.push_back(folder);
}

std::string whole_path(const std::string& file) {
    return file.empty() ? "" : std::filesystem::absolute(file).string();
}

// What the first frame needs on so many threads, as a manager is to allot it: a render takes seven eighths.
void plan_task(const LoadedGraph& loaded, Submission& job, Diagnostics& diagnostics) {
    RenderOptions options = loaded.options;
    options.threads = job.cpus;
    if (loaded.memory.by != "--memory") options.memory = 0;
    const std::optional<Plan> plan = plan_frame(*loaded.graph, job.frames.front(), options, diagnostics);
    if (!plan) return;
    job.memory = plan->memory_bytes / 7 * 8 + kBeside;
    for (const FrameInput& in : plan->frame.inputs) add_folder(job.input_folders, in.file);
    for (const Sink& sink : plan->frame.sinks) add_folder(job.output_folders, sink.request.file);
}

std::optional<Submission> prepared(const SubmitArguments& arguments, Diagnostics& diagnostics) {
    LoadedGraph loaded = load_graph(arguments.graph, diagnostics);
    if (loaded.graph)
        loaded.options.frames = frames_to_render(*loaded.graph, loaded.options.frames, diagnostics);
    Submission job = arguments.own;
    const auto count = [&](const char* option, const std::string& text, int most, int& out) {
        try {
            out = parse_count(text, 1, most);
        } catch (const Failure& f) {
            Error e = f.error();
            e.place = {std::string(option) + " " + text, 0, 0};
            diagnostics.error(std::move(e));
        }
    };
    count("--chunk", arguments.chunk, kMostFramesOfATask, job.chunk);
    count("--round", arguments.round, 100, job.round);
    count("--rounds", arguments.rounds, 100, job.rounds);
    if (arguments.graph.graph == "-")
        diagnostics.error(
            {ErrorKind::kGraph, {}, {}, "tasks read the graph themselves", "give it as a file"});
    if (!diagnostics.ok()) return std::nullopt;
    job.graph = arguments.graph;
    job.frames = loaded.options.frames;
    job.chunks = chunks_of(job.frames, job.chunk);
    job.name = arguments.name.empty() ? name_of(arguments.graph) : arguments.name;
    job.cpus = arguments.graph.threads.empty() ? 1 : loaded.options.threads;
    // What ran out of memory gets more in the next round.
    plan_task(loaded, job, diagnostics);
    job.memory *= static_cast<std::size_t>(job.round);
    job.partition = arguments.partition;
    job.logs = arguments.logs;
    job.program = arguments.program.empty() ? own_program() : arguments.program;
    return diagnostics.ok() ? std::optional(std::move(job)) : std::nullopt;
}

int run(const SubmitArguments& arguments, const std::string& manager) {
    Diagnostics diagnostics;
    const std::optional<Submission> job = prepared(arguments, diagnostics);
    report(diagnostics);
    if (!job) return exit_status(diagnostics);
    if (manager == "slurm") return submit_to_slurm(*job, {arguments.print, arguments.wait});
    if (manager == "openjd") return write_openjd_bundle(*job, arguments.bundle), 0;
    const FileManager& taker = *std::ranges::find(file_managers(), manager, &FileManager::name);
    if (arguments.files.empty())
        send_job(taker, *job);
    else
        write_job_files(taker, *job, arguments.files);
    return 0;
}

Command add_manager(const Command& submit, const std::shared_ptr<SubmitArguments>& arguments,
                    const std::string& name, const std::string& help) {
    const Command command = submit.add(name, help);
    add_graph_options(command, arguments->graph);
    command.option("--chunk", arguments->chunk, "N", "Frames of a task; 10 when absent");
    command.option("--threads", arguments->graph.threads, "N", "Cores of a task; 1 when absent");
    command.option("--memory", arguments->graph.memory, "SIZE",
                   "Memory that a task plans with; what is fastest when absent");
    command.option("--name", arguments->name, "NAME", "The job's name");
    command.runs([arguments, name] { return run(*arguments, name); });
    return command;
}

void add_program_option(const Command& command, SubmitArguments& arguments) {
    command.option("--program", arguments.program, "FILE",
                   "Where Keyline lies on the machines that render; where it lies here when absent");
}

// What each of the managers that take files asks for.
void add_own_options(const Command& command, const FileManager& manager, SubmitArguments& a) {
    add_program_option(command, a);
    command.option("--job", a.files, "DIR", "Write the job's files into this folder, and send nothing");
    for (const OwnOption& o : manager.options) command.option(o.name, a.own.*o.value, o.value_name, o.help);
}

}  // namespace

std::vector<std::string> command_words(const Submission& job, const char* command) {
    std::vector<std::string> out{job.program, command, whole_path(job.graph.graph)};
    const auto add = [&out](const std::string& option, const std::string& value) {
        if (!value.empty()) out.push_back(option + "=" + value);
    };
    for (const std::string& s : job.graph.set) add("--set", s);
    for (const std::string& s : job.graph.vars) add("--vars", whole_path(s));
    for (const std::string& s : job.graph.var) add("--var", s);
    for (const std::string& s : job.graph.only) add("--only", s);
    for (const std::string& s : job.graph.output) add("--output", s);
    add("--ocio", whole_path(job.graph.ocio));
    add("--root", whole_path(job.graph.root));
    add("--path-map", whole_path(job.graph.path_map));
    add("--threads", job.graph.threads);
    return out;
}

std::string shell_line(const std::vector<std::string>& words) {
    std::string out;
    for (const std::string& word : words) out += (out.empty() ? "" : " ") + shell_word(word);
    return out;
}

std::string all_frames(const Submission& job) {
    std::vector<int> frames = job.frames;
    std::ranges::sort(frames);
    std::string out = format_frames(frames);
    std::erase(out, ' ');
    return out;
}

std::string command_line(const Submission& job, const char* command) {
    std::string out = fmt::format("{} {} {}", shell_word(job.program), command, options_text(job.graph));
    for (const std::string& s : job.graph.only) out += " --only=" + shell_word(s);
    for (const std::string& s : job.graph.output) out += " --output=" + shell_word(s);
    return out;
}

void add_submit(const Command& program) {
    const Command submit = program.add("submit", "Give a sequence to a render farm's manager");
    submit.needs_one_below();
    const auto arguments = std::make_shared<SubmitArguments>();
    const Command slurm = add_manager(submit, arguments, "slurm",
                                      "An array of tasks for Slurm, and a job that verifies and repairs");
    slurm.option("--partition", arguments->partition, "NAME", "The partition; Slurm's when absent");
    slurm.option("--logs", arguments->logs, "DIR", "The folder of the logs; this one when absent");
    slurm.option("--rounds", arguments->rounds, "N",
                 "Tries of what is not current before the job fails; 3 when absent");
    slurm.option("--round", arguments->round, "N", "Which of them this is").hidden();
    slurm.flag("--print", arguments->print, "Print what would be submitted, and submit nothing");
    slurm.flag("--wait", arguments->wait, "Wait for the end; status 0 where all outputs are current then");
    add_program_option(slurm, *arguments);
    for (const FileManager& manager : file_managers())
        add_own_options(add_manager(submit, arguments, manager.name, manager.about), manager, *arguments);
    const Command openjd = add_manager(
        submit, arguments, "openjd", "A job bundle of Open Job Description, as AWS Deadline Cloud takes it");
    openjd.option("--bundle", arguments->bundle, "DIR", "The folder to write it into").required();
}

}  // namespace keyline::cli
