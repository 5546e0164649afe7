// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

// What of the machine this process may use.

namespace keyline::cli {

// What a process may use, and what decided it, for people.
struct Share {
    std::size_t amount = 0;
    std::string by;  // "SLURM_CPUS_PER_TASK", "the cores of the control group"
};

// Threads to start: as many as the least of what a render farm's manager allots to the task
// (SLURM_CPUS_PER_TASK, CUE_THREADS, NSLOTS), the process's affinity and its control group's share.
Share usable_threads();

// Bytes to use: most of what a manager allots to the task (SLURM_MEM_PER_NODE, SLURM_MEM_PER_CPU,
// CUE_MEMORY), half of what the machine, the control group and the limits of the process let it have; the
// least of them.
Share usable_memory();

// Has the allocator give large blocks back to the system as soon as they are free.  Left to itself, glibc
// takes to keeping them in its heaps, where holes remain: more or fewer by the order in which threads free
// theirs, so that --memory would hold on one day and not on the next.  Before anything is allocated.
void give_large_blocks_back();

// The most memory that this process held since the last call, in bytes, helper programs not counted; 0 where
// the system does not tell, and since its start where it does not let one begin anew.
std::size_t peak_memory_since_last();

// How many of so many threads the system lets this process start, itself counted.
int startable_threads(int wanted);

// The control group's limit on memory in bytes, SIZE_MAX where there is none.  `root` stands for "/".
std::size_t control_group_memory(const std::filesystem::path& root);

// The control group's share of processors, rounded up; INT_MAX where there is no limit.
int control_group_cores(const std::filesystem::path& root);

}  // namespace keyline::cli
