// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>

namespace keyline::cli {

// While it lives, a first SIGINT or SIGTERM asks for an end and a second one ends the process.  A signal that
// was ignored before stays ignored, as in a job under nohup.  One at a time.
class StopOnSignal {
public:
    StopOnSignal();
    ~StopOnSignal();
    StopOnSignal(const StopOnSignal&) = delete;
    StopOnSignal& operator=(const StopOnSignal&) = delete;

    // True once a signal came.
    const std::atomic<bool>& requested() const;
    int signal() const;  // 0 before

    // 130 after SIGINT, 143 after SIGTERM.
    int exit_status() const { return 128 + signal(); }
};

}  // namespace keyline::cli
