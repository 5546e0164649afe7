// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/io/exr_helper_protocol.h"

#include <chrono>
#include <cstddef>
#include <span>
#include <sys/types.h>
#include <vector>

namespace keyline::exr {

// A process that does with OpenEXR's C++ library what OpenEXRCore can't.  A damaged file may abort that
// library, or send it into an endless loop; the process has its own limits of memory and time, and only it
// dies. Used by one thread at a time.  It is started when it is first asked, and again after it died.
class Helper {
public:
    Helper() = default;
    ~Helper();
    Helper(const Helper&) = delete;
    Helper& operator=(const Helper&) = delete;

    // Sends the request and `file`, returns the reply's bytes.  Throws Failure (kInput) with what the library
    // says of the file, or that it died of it; kInternal where the helper can't be started.
    std::vector<std::byte> run(HelperRequest request, std::span<const std::byte> file);

private:
    using Deadline = std::chrono::steady_clock::time_point;

    void start();
    void stop();  // by force
    void send(std::span<const std::byte> bytes, Deadline deadline);
    void receive(std::span<std::byte> bytes, Deadline deadline);
    void wait_for(short events, Deadline deadline);
    [[noreturn]] void give_up(const char* why);

    int socket_ = -1;
    pid_t process_ = 0;
};

}  // namespace keyline::exr
