// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>

// What of the machine this process may use.

namespace keyline::cli {

// Cores that the process may run on: those of its affinity, and no more than its control group's share.
int available_cores();

// Bytes of memory: the machine's, or its control group's (version 1 or 2) where that is less.
std::size_t available_memory();

// The control group's limit on memory in bytes, SIZE_MAX where there is none.  `root` stands for "/".
std::size_t control_group_memory(const std::filesystem::path& root);

// The control group's share of processors, rounded up; INT_MAX where there is no limit.
int control_group_cores(const std::filesystem::path& root);

}  // namespace keyline::cli
