// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/common/report.h"

#include "cli/common/excerpt.h"

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <fmt/format.h>
#include <new>
#include <string>
#include <system_error>
#include <unistd.h>

namespace keyline::cli {

void fill_closed_streams() {
    // A system opens the lowest free descriptor.  Each is opened for what its stream is not used for: what a
    // command would print is still told to be lost.
    for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream) {
        if (fcntl(stream, F_GETFD) != -1 || errno != EBADF) continue;
        if (open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY) != stream) _exit(1);
    }
}

void print_result(std::string_view text) { std::fwrite(text.data(), 1, text.size(), stdout); }

void print_message(std::string_view line) {
    // In one call, so that lines of several processes do not mix.
    const std::string text = std::string(line) + "\n";
    std::fwrite(text.data(), 1, text.size(), stderr);
}

void print_error(const Error& error) { print_message(styled_error(error, message_style())); }

void print_warning(const Error& warning) { print_message(styled_warning(warning, message_style())); }

namespace {

std::atomic<void (*)(const Error&)> library_printer{print_warning};

}  // namespace

void print_library_warning(const std::string& library, const std::string& text) {
    library_printer.load()({ErrorKind::kFailed, {}, {}, library + ": " + text, {}});
}

void print_library_warnings_with(void (*print)(const Error&)) { library_printer = print; }

void report(const Diagnostics& diagnostics) {
    for (const Error& w : diagnostics.warnings()) print_warning(w);
    for (const Error& e : diagnostics.errors()) print_error(e);
}

Error error_of(const std::exception_ptr& thrown) {
    try {
        std::rethrow_exception(thrown);
    } catch (const Failure& f) {
        return f.error();
    } catch (const std::bad_alloc&) {
        return {
            ErrorKind::kFailed, {}, {}, "out of memory", "a smaller --memory makes a render use less of it",
            Passing::kMemory};
    } catch (const std::exception& e) {
        return {ErrorKind::kInternal, {}, {}, e.what(), {}};
    }
}

int exit_status(const Diagnostics& diagnostics) {
    return diagnostics.ok() ? 0 : exit_status(decisive(diagnostics.errors()));
}

void finish_results() {
    errno = 0;
    const bool lost = std::fflush(stdout) != 0 || std::ferror(stdout) != 0;
    if (lost && errno != EPIPE)
        fail(ErrorKind::kOutput, fmt::format("the result can't be written to standard output: {}",
                                             std::generic_category().message(errno)));
}

}  // namespace keyline::cli
