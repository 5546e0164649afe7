// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cli/common/options.h"

#include <string>
#include <vector>

// A sequence as a job of a render farm's manager.

namespace keyline::cli {

struct Submission {
    GraphArguments graph;             // as typed
    std::vector<int> frames;          // all
    std::vector<std::string> chunks;  // of them, as --frames takes each
    std::string name;
    std::vector<std::string> input_folders, output_folders;  // of the first frame
    int cpus = 1;                                            // of a task
    std::size_t memory = 0;                                  // bytes of a task
    int chunk = 1;                                           // frames of a task
    int round = 1, rounds = 1;  // tries of the whole, until what is not current is given up
    std::string partition;      // of Slurm; empty: its default
    std::string logs;           // the folder of the logs
    std::string program;        // where Keyline lies on the machines that render
    // What else managers ask for, each by options of its own; empty where it was not said.
    std::string user, show = "keyline", shot = "test", service, pool, group;
    std::string url = "http://localhost:8080";
};

// "keyline render GRAPH" and the options that say what is rendered, as a shell takes it.
std::string command_line(const Submission& job, const char* command);

// The same word by word, each file by its whole path: many managers start tasks in folders of their own.
std::vector<std::string> command_words(const Submission& job, const char* command);
std::string shell_line(const std::vector<std::string>& words);

// All frames in rising order, as --frames takes them, without blanks.
std::string all_frames(const Submission& job);

// An array of tasks, and a job after it that looks at the outputs and submits again what is not current.
// Returns the exit status.
struct SlurmOptions {
    bool print = false;  // what would be submitted, and submit nothing
    bool wait = false;   // for the end of all
};
int submit_to_slurm(const Submission& job, const SlurmOptions& options);

// Writes a job bundle of Open Job Description into a folder.
void write_openjd_bundle(const Submission& job, const std::string& folder);

}  // namespace keyline::cli
