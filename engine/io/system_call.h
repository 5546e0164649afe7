// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/error.h"

#include <cerrno>
#include <string>
#include <system_error>

// What the files of disks and servers have in common.

namespace keyline {

// Calls once more where a file server says ESTALE: it was restarted, or another machine replaced what a
// handle stood for; asked again by name, it finds what is there now.
template <class Call>
auto again_if_stale(const Call& call) {
    const auto result = call();
    return result < 0 && errno == ESTALE ? call() : result;
}

// What to do about an input that ends before all of it is there.
inline constexpr const char* kUnfinishedHint = "it is still being written or copied, or it was cut off";

inline std::string system_text(int error) { return std::generic_category().message(error); }

// What to do about an error that no file is the cause of; empty for others.
inline std::string system_hint(int error) {
    switch (error) {
        case ENOSPC: return "the disk is full: make room, or use another one";
        case EDQUOT: return "the quota is used up: make room, or have it raised";
        case EIO: return "the disk or the file server failed; the file itself may be sound";
        case ESTALE: return "another machine removed or replaced it meanwhile";
        default: return {};
    }
}

// Why such an error may be gone the next time.
inline Passing system_passing(int error) {
    switch (error) {
        case ENOSPC: return Passing::kSpace;
        case EDQUOT: return Passing::kQuota;
        case ESTALE: return Passing::kStale;
        case EIO:
        case EREMOTEIO: return Passing::kDevice;
        case ETIMEDOUT:
        case EHOSTDOWN:
        case EHOSTUNREACH:
        case ENETDOWN:
        case ENETUNREACH: return Passing::kTimeout;
        case ENOMEM: return Passing::kMemory;
        default: return Passing::kNever;
    }
}

}  // namespace keyline
