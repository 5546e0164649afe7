// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/error.h"

#include <string_view>

// What the program says.  Results go to standard output, everything else to standard error.

namespace keyline::cli {

// To standard output.
void print_result(std::string_view text);

// One line to standard error.  A reader that went away stops no render.
void print_message(std::string_view line);

// Prints warnings, then errors.
void report(const Diagnostics& diagnostics);

// 0 where there is no error; a graph that is wrong outranks the rest, of which the first counts.
int exit_status(const Diagnostics& diagnostics);

// Throws Failure (kOutput) where results were lost: a full disk, not a reader that had enough.
void finish_results();

}  // namespace keyline::cli
