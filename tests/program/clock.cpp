// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0

// Loaded before a program, it has the time of day stand at KEYLINE_CLOCK, in seconds.

#include <cstdlib>
#include <ctime>
#include <sys/syscall.h>
#include <sys/time.h>
#include <unistd.h>

namespace {

std::time_t told() {
    const char* clock = std::getenv("KEYLINE_CLOCK");
    return clock == nullptr ? 0 : std::atoll(clock);
}

}  // namespace

extern "C" {

std::time_t time(std::time_t* to) noexcept {
    if (to != nullptr) *to = told();
    return told();
}

int gettimeofday(timeval* to, void* /*zone*/) noexcept {
    *to = {told(), 0};
    return 0;
}

int clock_gettime(clockid_t clock, timespec* to) noexcept {
    const long result = syscall(SYS_clock_gettime, clock, to);
    if (clock == CLOCK_REALTIME) *to = {told(), 0};
    return static_cast<int>(result);
}
}
