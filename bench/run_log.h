// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/process.h"

#include <filesystem>
#include <fstream>
#include <string>

namespace keyline::bench {

// Every run as a line of a CSV file that report.py reads: experiment, what ran, x (what the experiment
// varies), round, seconds, MiB at most.  Runs of one round were made in turn: their ratios are pairs.
class RunLog {
public:
    // Appends to the file; a new one gets a header.  Throws std::runtime_error where it can't be written.
    explicit RunLog(const std::filesystem::path& file);

    void add(const std::string& experiment, const std::string& what, double x, int round,
             const Measured& run);

private:
    std::ofstream out_;
};

}  // namespace keyline::bench
