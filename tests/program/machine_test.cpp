// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/machine.h"

#include "tests/program/program.h"

#include <climits>
#include <cstdint>

// Control groups, on a made-up /proc and /sys.

namespace keyline::test {

namespace {

class Machine : public ProgramTest {};

TEST_F(Machine, WithoutControlGroupsThereIsNoLimit) {
    EXPECT_EQ(cli::control_group_memory(folder()), SIZE_MAX);
    EXPECT_EQ(cli::control_group_cores(folder()), INT_MAX);
}

TEST_F(Machine, Version2TakesTheLeastOfTheGroupAndThoseAbove) {
    write("proc/self/cgroup", "0::/farm/job\n");
    write("sys/fs/cgroup/farm/job/memory.max", "max\n");
    write("sys/fs/cgroup/farm/memory.max", "1073741824\n");
    write("sys/fs/cgroup/farm/job/cpu.max", "150000 100000\n");
    write("sys/fs/cgroup/farm/cpu.max", "max 100000\n");
    EXPECT_EQ(cli::control_group_memory(folder()), 1073741824U);
    EXPECT_EQ(cli::control_group_cores(folder()), 2);
}

TEST_F(Machine, Version1HasAFolderAController) {
    write("proc/self/cgroup", "5:cpu,cpuacct:/job\n4:memory:/job\n");
    write("sys/fs/cgroup/memory/job/memory.limit_in_bytes", "536870912\n");
    write("sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n");
    write("sys/fs/cgroup/cpu/job/cpu.cfs_quota_us", "400000\n");
    write("sys/fs/cgroup/cpu/job/cpu.cfs_period_us", "100000\n");
    write("sys/fs/cgroup/cpu/cpu.cfs_quota_us", "-1\n");
    write("sys/fs/cgroup/cpu/cpu.cfs_period_us", "100000\n");
    EXPECT_EQ(cli::control_group_memory(folder()), 536870912U);
    EXPECT_EQ(cli::control_group_cores(folder()), 4);
}

TEST_F(Machine, InAContainerTheMountItselfIsTheGroup) {
    write("proc/self/cgroup", "0::/docker/0123abcd\n");
    write("sys/fs/cgroup/memory.max", "268435456\n");
    EXPECT_EQ(cli::control_group_memory(folder()), 268435456U);
}

TEST_F(Machine, ThisOneHasSomething) {
    EXPECT_GE(cli::available_cores(), 1);
    EXPECT_GT(cli::available_memory(), std::size_t{1} << 20);
}

}  // namespace

}  // namespace keyline::test
