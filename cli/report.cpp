// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/report.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <fmt/format.h>
#include <string>
#include <system_error>

namespace keyline::cli {

void print_result(std::string_view text) { std::fwrite(text.data(), 1, text.size(), stdout); }

void print_message(std::string_view line) {
    // In one call, so that lines of several processes do not mix.
    const std::string text = std::string(line) + "\n";
    std::fwrite(text.data(), 1, text.size(), stderr);
}

void report(const Diagnostics& diagnostics) {
    for (const Error& w : diagnostics.warnings()) print_message(w.warning_text());
    for (const Error& e : diagnostics.errors()) print_message(e.text());
}

int exit_status(const Diagnostics& diagnostics) {
    if (diagnostics.ok()) return 0;
    const bool graph =
        std::ranges::any_of(diagnostics.errors(), [](const Error& e) { return e.kind == ErrorKind::kGraph; });
    return exit_status(graph ? ErrorKind::kGraph : diagnostics.errors().front().kind);
}

void finish_results() {
    errno = 0;
    const bool lost = std::fflush(stdout) != 0 || std::ferror(stdout) != 0;
    if (lost && errno != EPIPE)
        fail(ErrorKind::kOutput, fmt::format("the result can't be written to standard output: {}",
                                             std::generic_category().message(errno)));
}

}  // namespace keyline::cli
