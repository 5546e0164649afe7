// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/common/report.h"
#include "cli/common/run_program.h"
#include "cli/farm/submit.h"
#include "engine/params/frames.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <sstream>
#include <thread>

namespace keyline::cli {

namespace {

constexpr const char* kNotCurrent = "stale,damaged,missing,foreign";
constexpr int kTries = 3;  // of a task whose failure may pass, beside the first
constexpr std::chrono::seconds kBetweenLooks(1);

std::string without_blanks(std::string text) {
    std::erase(text, ' ');
    return text;
}

std::size_t megabytes(std::size_t bytes) { return (bytes + (std::size_t{1} << 20) - 1) >> 20; }

std::string head(const Submission& job, const std::string& log) {
    std::string out = fmt::format(
        "#!/bin/bash\n"
        "#SBATCH --job-name={}\n"
        "#SBATCH --cpus-per-task={}\n"
        "#SBATCH --mem={}M\n"
        "#SBATCH --requeue\n"
        "#SBATCH --open-mode=append\n"
        "#SBATCH --output={}\n",
        job.name, job.cpus, megabytes(job.memory), (std::filesystem::path(job.logs) / log).string());
    if (!job.partition.empty()) out += fmt::format("#SBATCH --partition={}\n", job.partition);
    return out;
}

// The time limit's signal goes to the script, which hands it on: what is unfinished is then taken away.
std::string render_script(const Submission& job) {
    std::string chunks;
    for (const std::string& c : job.chunks) chunks += " " + c;
    return head(job, job.name + "-%A_%a.log") +
           fmt::format(
               "#SBATCH --array=0-{}\n"
               "#SBATCH --signal=B:TERM@60\n"
               "frames=({})\n"
               "{} --frames=\"${{frames[$SLURM_ARRAY_TASK_ID]}}\" --stale --keep-going --progress lines &\n"
               "child=$!\n"
               "trap 'kill -TERM $child' TERM\n"
               "wait $child\n"
               "status=$?\n"
               "if [ $status -gt 128 ]; then wait $child; status=$?; fi\n"
               "# {}: another try may do better.\n"
               "if [ $status = {} ] && [ \"${{SLURM_RESTART_COUNT:-0}}\" -lt {} ]; then\n"
               "    scontrol requeue \"${{SLURM_ARRAY_JOB_ID}}_$SLURM_ARRAY_TASK_ID\"\n"
               "fi\n"
               "exit $status\n",
               job.chunks.size() - 1, chunks.substr(1), command_line(job, "render"), kTryAgain, kTryAgain,
               kTries);
}

std::string verify_script(const Submission& job) {
    const std::string frames = without_blanks(format_frames(job.frames));
    std::string out = head(job, job.name + "-%j.log") +
                      fmt::format(
                          "left=$({} --frames={} --list={})\n"
                          "status=$?\n"
                          "# 1: some are not current; others are faults that no other try mends.\n"
                          "if [ $status != 1 ]; then exit $status; fi\n",
                          command_line(job, "verify"), frames, kNotCurrent);
    if (job.round < job.rounds)
        out += fmt::format(
            "echo \"not current after round {}: $left\"\n"
            "exec {} --frames=\"$left\" --chunk={} --name={} --threads={} --logs={} --round={} "
            "--rounds={}{}\n",
            job.round, command_line(job, "submit slurm"), job.chunk, shell_word(job.name), job.cpus,
            shell_word(job.logs), job.round + 1, job.rounds,
            job.partition.empty() ? "" : " --partition=" + shell_word(job.partition));
    else
        out += fmt::format("echo \"not current after {} rounds: $left\"\nexit 1\n", job.rounds);
    return out;
}

// Returns the job's number.
std::string submit(const std::string& script, const std::vector<std::string>& more = {}) {
    std::vector<std::string> command{"sbatch", "--parsable"};
    command.insert(command.end(), more.begin(), more.end());
    const ProgramResult result = run_program(command, script);
    if (result.status != 0)
        fail(ErrorKind::kFailed, fmt::format("sbatch ended with status {}", result.status),
             "it says why above");
    return result.out.substr(0, result.out.find_first_of(";\n"));
}

// "2 RUNNING, 5 PENDING"; empty where nothing is left.
std::string states_of(const std::string& name) {
    const ProgramResult result =
        run_program({"squeue", "--noheader", "--array", "--name=" + name, "--format=%T"});
    if (result.status != 0)
        fail(ErrorKind::kFailed, fmt::format("squeue ended with status {}", result.status));
    std::map<std::string, int> counts;
    std::istringstream lines(result.out);
    for (std::string state; std::getline(lines, state);) ++counts[state];
    std::string out;
    for (const auto& [state, n] : counts) out += fmt::format("{}{} {}", out.empty() ? "" : ", ", n, state);
    return out;
}

int wait_for(const Submission& job) {
    std::string told;
    for (std::string now = states_of(job.name); !now.empty(); now = states_of(job.name)) {
        if (now != told) print_message(fmt::format("{}: {}", job.name, now));
        told = now;
        std::this_thread::sleep_for(kBetweenLooks);
    }
    const std::string frames = without_blanks(format_frames(job.frames));
    const ProgramResult left = run_program(
        {"/bin/sh", "-c",
         fmt::format("exec {} --frames={} --list={}", command_line(job, "verify"), frames, kNotCurrent)});
    if (left.status == 0)
        print_message(fmt::format("keyline: done frames={} retry=no reason=none", frames));
    else
        print_message(
            fmt::format("keyline: failed frames={} retry=no reason=failed",
                        left.out.empty() ? frames : without_blanks(left.out.substr(0, left.out.find('\n')))));
    return left.status;
}

}  // namespace

int submit_to_slurm(const Submission& job, const SlurmOptions& options) {
    const std::string render = render_script(job), verify = verify_script(job);
    if (options.print) {
        print_result(fmt::format("# sbatch\n{}\n# sbatch --dependency=afterany:JOB\n{}", render, verify));
        return 0;
    }
    std::filesystem::create_directories(job.logs);
    const std::string array = submit(render);
    const std::string after = submit(verify, {"--dependency=afterany:" + array});
    print_message(fmt::format("{}: job {} renders {} tasks, job {} verifies", job.name, array,
                              job.chunks.size(), after));
    return options.wait ? wait_for(job) : 0;
}

}  // namespace keyline::cli
