// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0

// Whole jobs as whole processes, in turn with OpenEXR's own read + write of the same channels:
//     bench_jobs PLATE.exr [RUNS]
// PLATE is an HD frame with a Combined layer.  Prints a Markdown table.

#include "bench/process.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <iostream>
#include <string>
#include <thread>
#include <unistd.h>
#include <vector>

namespace keyline::bench {
namespace {

namespace fs = std::filesystem;

const fs::path kBin = fs::read_symlink("/proc/self/exe").parent_path();
const fs::path kGraph = kBin.parent_path().parent_path().parent_path() / "bench" / "lines.json";

struct Job {
    std::string name;
    std::vector<std::string> command;
    std::vector<Measured> runs;
};

// Runs the jobs in turn, so that a machine that slows down slows all of them.
void run_in_turn(std::vector<Job>& jobs, int runs) {
    for (int i = 0; i < runs; ++i)
        for (Job& job : jobs) job.runs.push_back(run_process(job.command));
}

std::vector<std::string> keyline_job(const fs::path& plate, const fs::path& out, int threads) {
    return {kBin / "keyline",
            "render",
            kGraph,
            "--var",
            "plate=" + plate.string(),
            "--var",
            "out=" + out.string(),
            "--threads",
            std::to_string(threads),
            "--progress",
            "none"};
}

std::vector<std::string> copy_job(const fs::path& plate, const fs::path& out, int threads) {
    return {kBin / "bench_exr_copy", plate, "ViewLayer.Combined", out, std::to_string(threads)};
}

fs::path mosaic(const fs::path& plate, int n, const fs::path& folder) {
    fs::path out = folder / fmt::format("plate-{}x{}.exr", n, n);
    run_process({kBin / "bench_mosaic", plate, std::to_string(n), out});
    return out;
}

void print_row(const Job& job, const Measured& base) {
    const Measured m = summary(job.runs);
    std::cout << fmt::format("| {} | {:.3f} s | {:.2f} | {} MiB |\n", job.name, m.seconds,
                             m.seconds / base.seconds, m.peak_bytes >> 20);
}

void compare(const std::string& title, const fs::path& plate, const fs::path& folder, int runs) {
    const int threads = static_cast<int>(std::thread::hardware_concurrency());
    std::vector<Job> jobs{
        {fmt::format("OpenEXR read + write, {} threads", threads),
         copy_job(plate, folder / "copy.exr", threads),
         {}},
        {fmt::format("Keyline, {} threads", threads), keyline_job(plate, folder / "lines.exr", threads), {}},
        {"Keyline, 1 thread", keyline_job(plate, folder / "lines1.exr", 1), {}}};
    run_in_turn(jobs, runs);
    const Measured base = summary(jobs[0].runs);
    std::cout << fmt::format("\n| {} | time | against OpenEXR | peak memory |\n| --- | --- | --- | --- |\n",
                             title);
    for (const Job& job : jobs) print_row(job, base);
}

int run(const fs::path& plate, int runs) {
    const fs::path folder = fs::temp_directory_path() / fmt::format("keyline-bench-{}", getpid());
    fs::create_directories(folder);
    compare("1920×1080", plate, folder, runs);
    compare("3840×2160", mosaic(plate, 2, folder), folder, runs);
    compare("7680×4320", mosaic(plate, 4, folder), folder, std::max(1, runs / 3));
    fs::remove_all(folder);
    return 0;
}

}  // namespace
}  // namespace keyline::bench

int main(int argc, char** argv) {
    if (argc < 2) {
        std::cerr << "usage: bench_jobs PLATE.exr [RUNS]\n";
        return 2;
    }
    try {
        return keyline::bench::run(argv[1], argc > 2 ? std::atoi(argv[2]) : 5);
    } catch (const std::exception& e) {
        std::cerr << "error: " << e.what() << '\n';
        return 1;
    }
}
