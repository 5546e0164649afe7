// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/common/machine.h"

#include "tests/program/program.h"

#include <climits>
#include <cstdint>
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

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
    EXPECT_GE(cli::usable_threads().amount, 1U);
    EXPECT_GT(cli::usable_memory().amount, std::size_t{1} << 20);
}

// A machine of sixty-four cores of which the task was given one: the manager's word counts, and plan says so.
TEST_F(Machine, AManagersAllotmentIsTheMachine) {
    graph(R"("c": { "type": "constant", "color": [0, 0, 0], "size": [4, 4] },
             "out": { "type": "write", "in": "c", "file": "out.exr" })");
    struct Case {
        std::vector<std::string> environment;
        const char* limits;
    };
    for (const Case& c :
         {Case{
              {"SLURM_CPUS_PER_TASK=1", "SLURM_MEM_PER_NODE=512"},
              "limits: 1 thread: SLURM_CPUS_PER_TASK; 448M of memory: seven eighths of SLURM_MEM_PER_NODE\n"},
          Case{{"SLURM_CPUS_PER_TASK=1", "SLURM_MEM_PER_CPU=256"},
               "limits: 1 thread: SLURM_CPUS_PER_TASK; 224M of memory: seven eighths of SLURM_MEM_PER_CPU\n"},
          Case{{"CUE_THREADS=1", "CUE_MEMORY=262144"},
               "limits: 1 thread: CUE_THREADS; 224M of memory: seven eighths of CUE_MEMORY\n"},
          Case{{"NSLOTS=1", "SLURM_MEM_PER_NODE=0", "CUE_MEMORY=2G"}, "limits: 1 thread: NSLOTS; "}}) {
        const Outcome run = keyline({"plan", "graph.json"}, {.environment = c.environment});
        EXPECT_EQ(run.status, 0) << run.err;
        EXPECT_THAT(run.out, testing::HasSubstr(c.limits));
    }
    EXPECT_THAT(keyline({"plan", "graph.json", "--threads", "3", "--memory", "1G"},
                        {.environment = {"SLURM_CPUS_PER_TASK=1", "SLURM_MEM_PER_NODE=512"}})
                    .out,
                testing::HasSubstr("limits: 3 threads: --threads; 1024M of memory: --memory\n"));
}

// It is not the graph that is wrong then.
TEST_F(Machine, AnAllotmentThatIsTooSmallNamesItself) {
    graph(R"("c": { "type": "constant", "color": [0, 0, 0], "size": [4, 4] },
             "out": { "type": "write", "in": "c", "file": "out.exr" })");
    const Outcome run = keyline({"render", "graph.json"}, {.environment = {"SLURM_MEM_PER_NODE=1"}});
    EXPECT_EQ(run.status, 75) << "a task with more may be tried";
    EXPECT_THAT(run.err, testing::HasSubstr("it is seven eighths of SLURM_MEM_PER_NODE"));
    const Outcome typed = keyline({"render", "graph.json", "--memory", "1M"});
    EXPECT_EQ(typed.status, 2);
    EXPECT_TRUE(typed.err.starts_with("--memory 1M: error: the memory limit is 1M")) << typed.err;
}

// A user who may have two processes: this one and the program.
TEST_F(Machine, ThreadsThatCantBeStartedAreDoneWithout) {
    graph(R"("c": { "type": "constant", "color": [0, 0, 0], "size": [512, 512] },
             "out": { "type": "write", "in": "c", "file": "out.exr" })");
    if (geteuid() != 0) GTEST_SKIP() << "only the superuser can become another user";
    fs::permissions(folder(), fs::perms(0777));
    const pid_t child = fork();
    if (child == 0) {
        const rlimit two{2, 2};
        if (setrlimit(RLIMIT_NPROC, &two) != 0 || setuid(61234) != 0) _exit(100);
        if (access(KEYLINE_PROGRAM, X_OK) != 0) _exit(77);
        const Outcome run = keyline({"render", "graph.json", "--threads", "4"});
        const bool told = run.err.find("warning: the system lets this process start 0 of 3") == 0;
        _exit(run.status != 0 ? run.status : told ? 0 : 101);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    if (WEXITSTATUS(status) == 77) GTEST_SKIP() << "another user may not run the program";
    EXPECT_EQ(WEXITSTATUS(status), 0);
    EXPECT_TRUE(exists("out.exr"));
}

}  // namespace

}  // namespace keyline::test
