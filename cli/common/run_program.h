// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace keyline::cli {

struct ProgramResult {
    int status = 0;   // as a shell tells it: 128 and the signal that ended it
    std::string out;  // of its standard output
};

// Runs another program to its end, found as a shell finds it, with this text as its standard input.  Throws
// Failure (kFailed) where it can't be started.
ProgramResult run_program(const std::vector<std::string>& arguments, const std::string& in = {});

// This program's own file.
std::string own_program();

}  // namespace keyline::cli
