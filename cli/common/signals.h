// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>

namespace keyline::cli {

// While it lives, a first SIGINT, SIGTERM or SIGHUP asks for an end and a second one ends the process.  A
// signal that was ignored before stays ignored, as in a job under nohup.  One at a time.
class StopOnSignal {
public:
    StopOnSignal();
    ~StopOnSignal();
    StopOnSignal(const StopOnSignal&) = delete;
    StopOnSignal& operator=(const StopOnSignal&) = delete;

    // True once a signal came.
    const std::atomic<bool>& requested() const;
    int signal() const;  // 0 before

    const char* signal_name() const;  // "SIGTERM"

    // 130 after SIGINT, 143 after SIGTERM, 129 after SIGHUP.
    int exit_status() const { return 128 + signal(); }
};

}  // namespace keyline::cli
