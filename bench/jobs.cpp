// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0

// Whole jobs as whole processes, in turn:  bench_jobs HD.exr SMALL.exr FOLDER RUNS.csv ROUNDS
// HD is a frame with a Combined layer, of which 4K and 8K plates are made in FOLDER (and used again), SMALL a
// small one.  Every run goes to RUNS.csv; report.py makes tables of them.

#include "bench/commands.h"
#include "bench/process.h"
#include "bench/run_log.h"

#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <iostream>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace keyline::bench {
namespace {

namespace fs = std::filesystem;

constexpr int kFrames = 12;
constexpr int kShortRounds = 5;  // of what takes milliseconds, for one of the others

struct Job {
    std::string name;
    double x;
    Command command;
    Command beside = {};  // at the same time, where it is not empty
};

Plate open_plate(const fs::path& file) {
    const auto window = Imf::InputFile(file.c_str()).header().dataWindow();
    return {file, window.max.x - window.min.x + 1, window.max.y - window.min.y + 1};
}

class Suite {
public:
    Suite(const fs::path& hd, const fs::path& small, fs::path folder, const fs::path& log, int rounds)
        : folder_(std::move(folder)),
          log_(log),
          rounds_(rounds),
          threads_(static_cast<int>(std::thread::hardware_concurrency())),
          hd_(open_plate(fs::absolute(hd))),
          small_(open_plate(fs::absolute(small))) {
        fs::create_directories(folder_);
    }

    void run() {
        check();
        sequence("HD", hd_);
        sequence("small", small_);
        const Plate uhd = large(2);
        job(uhd);
        toon(uhd);
        threads(uhd);
        sigma(uhd);
        sizes({small_, hd_, uhd, large(3), large(4)});
    }

private:
    fs::path out(const std::string& name) const { return folder_ / (name + ".exr"); }

    Plate large(int n) const {
        const fs::path file = out(fmt::format("plate-{}x{}-of-{}", n, n, hd_.file.stem().string()));
        if (!fs::exists(file)) {
            const fs::path unfinished = out("unfinished");
            run_process(mosaic(hd_.file, n, unfinished));
            fs::rename(unfinished, file);
        }
        return open_plate(file);
    }

    // In turn, so that a machine that slows down slows all of them; once before without counting, so that
    // what they read is in memory.
    void in_turn(const std::string& experiment, const std::vector<Job>& jobs, int rounds) {
        std::cerr << experiment << '\n';
        for (int round = -1; round < rounds; ++round)
            for (const Job& j : jobs) {
                const Measured run =
                    j.beside.empty() ? run_process(j.command) : run_together({j.command, j.beside});
                if (round >= 0) log_.add(experiment, j.name, j.x, round, run);
            }
    }

    // The job itself against OpenEXR and the other programs.
    void job(const Plate& plate) {
        std::vector<Job> jobs{{"OpenEXR read + write", 0, openexr_copy(plate.file, out("copy"), threads_)},
                              {"Keyline", 0, keyline_job(plate.file, out("lines"), threads_)}};
        run_process(jobs.front().command);
        for (const Peer& peer : peers(plate, folder_, threads_)) {
            if (!is_installed(peer.program)) {
                std::cerr << "left out, not installed: " << peer.name << '\n';
                continue;
            }
            if (!peer.prepare.empty()) run_process(peer.prepare);
            jobs.push_back({peer.name, 0, peer.command});
        }
        in_turn("job", jobs, rounds_);
    }

    void toon(const Plate& plate) {
        std::vector<Job> jobs;
        for (int n = 1; n <= threads_; n *= 2) {
            jobs.push_back(
                {"OpenEXR read + write", double(n), openexr_copy_of_toon(plate.file, out("copy"), n)});
            jobs.push_back({"Keyline", double(n), keyline_toon(plate.file, out("toon"), n)});
        }
        in_turn("toon", jobs, rounds_);
    }

    void threads(const Plate& plate) {
        std::vector<Job> jobs;
        for (int n = 1; n <= 2 * threads_; n *= 2) {
            jobs.push_back({"Keyline", double(n), keyline_job(plate.file, out("lines"), n)});
            jobs.push_back({"OpenEXR read + write", double(n), openexr_copy(plate.file, out("copy"), n)});
        }
        jobs.push_back({"Keyline, two at once", 1, keyline_job(plate.file, out("lines"), 1),
                        keyline_job(plate.file, out("lines-beside"), 1)});
        in_turn("threads", jobs, rounds_);
    }

    void sigma(const Plate& plate) {
        std::vector<Job> jobs;
        for (const double s : {0.7, 1.4, 2.8, 5.6, 11.2, 22.4, 44.8})
            jobs.push_back({"Keyline", s,
                            keyline_job(plate.file, out("lines"), threads_,
                                        {"--set", fmt::format("smooth.sigma={}", s)})});
        in_turn("sigma", jobs, rounds_);
    }

    void sizes(const std::vector<Plate>& plates) {
        std::vector<Job> jobs;
        for (const Plate& p : plates) {
            jobs.push_back({"Keyline", p.pixels(), keyline_job(p.file, out("lines"), threads_)});
            for (const char* memory : {"256M", "384M"})
                jobs.push_back({fmt::format("Keyline --memory {}", memory), p.pixels(),
                                keyline_job(p.file, out("lines"), threads_, {"--memory", memory})});
            jobs.push_back({"OpenEXR read + write", p.pixels(), openexr_copy(p.file, out("copy"), threads_)});
        }
        in_turn("size", jobs, rounds_);
    }

    // The frames are names of one file: they differ in nothing that costs time.
    void sequence(const std::string& name, const Plate& plate) {
        const fs::path frames = folder_ / ("sequence-" + name);
        fs::remove_all(frames);
        fs::create_directories(frames);
        for (int i = 1; i <= kFrames; ++i)
            fs::create_symlink(plate.file, frames / fmt::format("plate.{:04}.exr", i));
        const fs::path in = frames / "plate.####.exr", to = frames / "lines.####.exr";
        in_turn(
            "sequence " + name,
            {{"Keyline", 1, keyline_job(in, to, threads_, {"--frames", "1"})},
             {"Keyline", kFrames, keyline_job(in, to, threads_, {"--frames", fmt::format("1-{}", kFrames)})}},
            rounds_);
        fs::remove_all(frames);
    }

    void check() {
        const fs::path sources = KEYLINE_SOURCE_DIR;
        const auto command = [&](const Command& arguments) {
            return Command{programs() / "keyline"} + arguments;
        };
        in_turn("check",
                {{"a graph of OpenEXR files", 0,
                  command({"check", sources / "bench" / "lines.json", "--var",
                           "plate=" + small_.file.string(), "--var", "out=" + out("lines").string()})},
                 {"a graph that writes PNG too", 0, command({"check", sources / "graphs" / "toon.json"})}},
                kShortRounds * rounds_);
    }

    const fs::path folder_;
    RunLog log_;
    const int rounds_, threads_;
    const Plate hd_, small_;
};

}  // namespace
}  // namespace keyline::bench

int main(int argc, char** argv) {
    if (argc != 6) {
        std::cerr << "usage: bench_jobs HD.exr SMALL.exr FOLDER RUNS.csv ROUNDS\n";
        return 2;
    }
    try {
        keyline::bench::Suite(argv[1], argv[2], argv[3], argv[4], std::atoi(argv[5])).run();
    } catch (const std::exception& e) {
        std::cerr << "error: " << e.what() << '\n';
        return 1;
    }
    return 0;
}
