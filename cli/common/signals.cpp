// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/common/signals.h"

#include <array>
#include <csignal>
#include <unistd.h>

namespace keyline::cli {

namespace {

// SIGHUP: the terminal or the connection that the render was started from is gone.
constexpr std::array kSignals{SIGINT, SIGTERM, SIGHUP};

// A signal's handler can be given nothing: these are the only way to hear of it.
std::atomic<bool> stop_requested{false};
std::atomic<int> signal_received{0};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

void on_signal(int signal) {
    if (stop_requested.exchange(true)) _exit(128 + signal);
    signal_received = signal;
}

void set_handler(int signal, void (*handler)(int)) {
    struct sigaction action = {};
    action.sa_handler = handler;
    action.sa_flags = SA_RESTART;
    sigaction(signal, &action, nullptr);
}

bool is_ignored(int signal) {
    struct sigaction action = {};
    return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

}  // namespace

StopOnSignal::StopOnSignal() {
    for (const int signal : kSignals)
        if (!is_ignored(signal)) set_handler(signal, on_signal);
}

StopOnSignal::~StopOnSignal() {
    for (const int signal : kSignals)
        if (!is_ignored(signal)) set_handler(signal, SIG_DFL);
}

const std::atomic<bool>& StopOnSignal::requested() const { return stop_requested; }
int StopOnSignal::signal() const { return signal_received; }

const char* StopOnSignal::signal_name() const {
    return signal() == SIGINT ? "SIGINT" : signal() == SIGHUP ? "SIGHUP" : "SIGTERM";
}

}  // namespace keyline::cli
