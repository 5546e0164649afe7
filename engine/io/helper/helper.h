// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/io/helper/protocol.h"

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace keyline {

// A helper program: where libraries run that may crash, hang or take all memory on a damaged file.  Its
// sessions have limits of memory and time, and only a session dies.
struct HelperProgram {
    std::string_view name;     // in helper_folder()
    std::string_view library;  // whom to blame: "OpenEXR's library"
};

// What a request may take.
struct HelperBounds {
    uint64_t memory = 0;       // bytes, beyond what the session has
    uint64_t seconds = 0;      // of processor time; it is waited for longer
    uint64_t reply_bytes = 0;  // at most
};

// One session with a helper program, used by one thread at a time.  It is started when it is first asked; and
// anew after a failure, as nobody knows what a damaged file has done to it.
class Helper {
public:
    explicit Helper(const HelperProgram& program);
    ~Helper();
    Helper(const Helper&) = delete;
    Helper& operator=(const Helper&) = delete;

    // Sends the request and its bytes, returns the reply's.  `descriptor` is an open file for the helper, or
    // -1.  Throws Failure: with what the helper says of the file, or (kInput) that the library died of it;
    // kInternal where the helper can't be started.
    std::vector<std::byte> run(HelperRequest request, const HelperBounds& bounds,
                               std::span<const std::byte> bytes, int descriptor = -1);

    // The same in two steps: what went wrong is told by whatever is asked next.
    void begin(HelperRequest request, const HelperBounds& bounds, std::span<const std::byte> bytes,
               int descriptor = -1);
    std::vector<std::byte> end();

    // Memory that the helper sees too, at least so many bytes; none where the system refuses it.
    std::span<std::byte> shared(std::size_t bytes);

    // Ends the session, whatever it is at.
    void drop() { stop(); }
    bool is_running() const { return socket_ >= 0; }

private:
    using Deadline = std::chrono::steady_clock::time_point;

    void start();
    void stop();  // by force
    void send(std::span<const std::byte> bytes, int descriptor = -1);
    void receive(std::span<std::byte> bytes);
    void wait_for(short events);
    [[noreturn]] void give_up(std::string_view what_the_library_did);

    const HelperProgram& program_;
    int socket_ = -1, memory_ = -1;
    uint64_t session_ = 0;
    std::span<std::byte> shared_;
    bool is_asked_ = false;  // a reply is to come
    uint64_t most_reply_ = 0;
    Deadline deadline_;
};

// Whether the program has been started by this process and not been seen to end.
bool helper_is_running(const HelperProgram& program);

// The folder of Keyline's own helper programs, beside its library.
std::filesystem::path helper_folder();

}  // namespace keyline
