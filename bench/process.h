// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace keyline::bench {

struct Measured {
    double seconds = 0;          // wall clock, the whole process
    std::size_t peak_bytes = 0;  // resident, at most
};

// Runs a program to its end, its output thrown away.  Throws std::runtime_error where it can't be run or
// fails.
Measured run_process(const std::vector<std::string>& command);

// Several at the same time: until the last has ended, and the most that one of them took.
Measured run_together(const std::vector<std::vector<std::string>>& commands);

}  // namespace keyline::bench
