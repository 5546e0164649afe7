// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

// What Keyline and a helper program say to each other, whatever the program is for.
//
// A helper program is started once.  It loads its libraries and then only starts sessions: for each, a copy
// of itself, with a socket and a piece of memory that Keyline sees too.  In a session, requests and replies
// follow each other over the socket, each with its bytes; it ends when the socket is closed.

namespace keyline {

// Over the program's standard input, one packet each.  kStart comes with the session's socket and memory.
struct HelperOrder {
    enum class Kind : uint64_t { kStart, kKill } kind;
    uint64_t session;
};

struct HelperRequest {
    uint32_t task;            // a number of the program's own
    int32_t first_row, rows;  // what the task is about
    uint32_t has_descriptor;  // 1: an open file comes with the bytes' first one
    uint64_t bytes;
    uint64_t shared_bytes;  // how much of the memory that both see there is
    uint64_t memory;        // bytes that the session may take beyond what it has
    uint64_t seconds;       // of processor time that it may take
};

struct HelperReply {
    enum class Outcome : uint32_t {
        kDone,          // the bytes are what was asked for
        kInputFailed,   // else they are what went wrong, 0, and what to do
        kOutputFailed,  //
        kFailed,        //
    } outcome;
    uint32_t passing;  // of a failure: why it may be gone the next time, a Passing of engine/base/error.h
    uint64_t bytes;
};

}  // namespace keyline
