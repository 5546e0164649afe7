// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/error.h"

#include <exception>
#include <string>
#include <string_view>

// What the program says.  Results go to standard output, everything else to standard error.

namespace keyline::cli {

// Fills those of the descriptors 0, 1 and 2 that are closed, so that no file is opened as one of them and
// gets what is meant for a terminal.  Writing to them fails as it did before.  Before anything else in
// main().
void fill_closed_streams();

// To standard output.
void print_result(std::string_view text);

// One line to standard error.  A reader that went away stops no render.
void print_message(std::string_view line);

// An error or a warning; on a terminal with the line that it is about, and colour.
void print_error(const Error& error);
void print_warning(const Error& warning);

// What a library has to say beside its results, as a warning.
void print_library_warning(const std::string& library, const std::string& text);

// How warnings of libraries are printed from now on; by default as lines of text.  On any thread.
void print_library_warnings_with(void (*print)(const Error& warning));

// Prints warnings, then errors.
void report(const Diagnostics& diagnostics);

// What was thrown, as an error: memory that ran out, too, and what nobody foresaw.
Error error_of(const std::exception_ptr& thrown);

// 0 where there is no error, else that of the decisive one.
int exit_status(const Diagnostics& diagnostics);

// Throws Failure (kOutput) where results were lost: a full disk, not a reader that had enough.
void finish_results();

}  // namespace keyline::cli
