// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/common/machine.h"

#include <algorithm>
#include <charconv>
#include <climits>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <functional>
#include <latch>
#include <malloc.h>
#include <optional>
#include <sched.h>
#include <sstream>
#include <string>
#include <string_view>
#include <sys/resource.h>
#include <system_error>
#include <thread>
#include <unistd.h>
#include <vector>

namespace keyline::cli {

namespace {

namespace fs = std::filesystem;

// The folder of this process's group under a controller's mount, and those above it: a limit of any of them
// holds.  Inside a container the path may be that of the host, which is not there; the mount's own folder is.
void for_each_group(const fs::path& mount, const std::string& group,
                    const std::function<void(const fs::path&)>& visit) {
    fs::path below = fs::path(group).relative_path();
    for (;; below = below.parent_path()) {
        visit(mount / below);
        if (below.empty()) return;
    }
}

// Visits the groups of version 2 with `v2` and those of a version 1 controller with `v1`.
void for_each_limit(const fs::path& root, const std::string& controller,
                    const std::function<void(const fs::path&)>& v1,
                    const std::function<void(const fs::path&)>& v2) {
    std::ifstream groups(root / "proc/self/cgroup");
    for (std::string line; std::getline(groups, line);) {
        std::istringstream fields(line);
        std::string id, controllers, group;
        std::getline(fields, id, ':');
        std::getline(fields, controllers, ':');
        std::getline(fields, group);
        if (controllers.empty())
            for_each_group(root / "sys/fs/cgroup", group, v2);
        else if (("," + controllers + ",").find("," + controller + ",") != std::string::npos)
            for_each_group(root / "sys/fs/cgroup" / controller, group, v1);
    }
}

std::optional<double> first_number(const fs::path& file) {
    std::ifstream in(file);
    double number = 0;
    return in >> number ? std::optional(number) : std::nullopt;  // "max" is none
}

constexpr std::size_t kMega = std::size_t{1} << 20;
// Eighths of what a manager allots to a task alone: an eighth for what an estimate may be wrong by, and for
// the script that started the program.
constexpr std::size_t kOfAllotment = 7;

// A whole number above 0 in the environment; nothing where there is none.
std::optional<std::size_t> allotted(const char* name) {
    const char* text = std::getenv(name);
    if (!text) return std::nullopt;
    const std::string_view all(text);
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(all.data(), all.data() + all.size(), number);
    if (error != std::errc() || end != all.data() + all.size() || number == 0) return std::nullopt;
    return number;
}

std::size_t limit_of_process(__rlimit_resource_t which) {
    rlimit limit{};
    if (getrlimit(which, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return SIZE_MAX;
    return limit.rlim_cur;
}

// Of equals the later, which is the more particular, is named.
void take_less(Share& least, Share other) {
    if (other.amount <= least.amount) least = std::move(other);
}

}  // namespace

std::size_t control_group_memory(const fs::path& root) {
    std::size_t least = SIZE_MAX;
    const auto limit = [&](const fs::path& file) {
        std::ifstream in(file);
        std::size_t bytes = 0;
        if (in >> bytes) least = std::min(least, bytes);
    };
    for_each_limit(
        root, "memory", [&](const fs::path& g) { limit(g / "memory.limit_in_bytes"); },
        [&](const fs::path& g) { limit(g / "memory.max"); });
    return least;
}

int control_group_cores(const fs::path& root) {
    double least = INT_MAX;
    const auto share = [&](double quota, double period) {
        if (quota > 0 && period > 0) least = std::min(least, std::max(1.0, std::ceil(quota / period)));
    };
    for_each_limit(
        root, "cpu",
        [&](const fs::path& g) {
            share(first_number(g / "cpu.cfs_quota_us").value_or(0),
                  first_number(g / "cpu.cfs_period_us").value_or(0));
        },
        [&](const fs::path& g) {
            std::ifstream in(g / "cpu.max");
            double quota = 0, period = 0;
            if (in >> quota >> period) share(quota, period);
        });
    return static_cast<int>(least);
}

Share usable_threads() {
    cpu_set_t set;
    CPU_ZERO(&set);
    const bool known = sched_getaffinity(0, sizeof set, &set) == 0;
    const auto cores =
        known ? static_cast<std::size_t>(CPU_COUNT(&set)) : std::thread::hardware_concurrency();
    Share least{std::max<std::size_t>(1, cores), "the cores that the process may run on"};
    take_less(least, {static_cast<std::size_t>(control_group_cores("/")), "the cores of the control group"});
    for (const char* name : {"SLURM_CPUS_PER_TASK", "CUE_THREADS", "NSLOTS"})
        take_less(least, {allotted(name).value_or(SIZE_MAX), name});
    return least;
}

Share usable_memory() {
    const auto pages = static_cast<std::size_t>(sysconf(_SC_PHYS_PAGES));
    const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    Share least{pages * page / 2, "half of the machine's"};
    const bool is_allotted =
        allotted("SLURM_MEM_PER_NODE") || allotted("SLURM_MEM_PER_CPU") || allotted("CUE_MEMORY");
    // The group is then the task's own.
    const std::size_t group = control_group_memory("/");
    take_less(least, is_allotted ? Share{group / 8 * kOfAllotment, "seven eighths of the control group's"}
                                 : Share{group / 2, "half of the control group's"});
    take_less(least, {limit_of_process(RLIMIT_AS) / 2, "half of the process's address space (ulimit -v)"});
    take_less(least, {limit_of_process(RLIMIT_DATA) / 2, "half of the process's data (ulimit -d)"});
    const auto take = [&](const char* name, std::size_t unit) {
        if (const auto n = allotted(name); n && *n < SIZE_MAX / unit / kOfAllotment)
            take_less(least, {*n * unit / 8 * kOfAllotment, fmt::format("seven eighths of {}", name)});
    };
    take("SLURM_MEM_PER_NODE", kMega);
    take("SLURM_MEM_PER_CPU", kMega * allotted("SLURM_CPUS_PER_TASK").value_or(1));
    take("CUE_MEMORY", 1024);
    return least;
}

void give_large_blocks_back() {
    // A fixed threshold is never raised.  Twice as large a one left 4 MiB more behind in four frames at
    // 1080p.
    [[maybe_unused]] constexpr int kLarge = 128 << 10;
#ifdef M_MMAP_THRESHOLD
    mallopt(M_MMAP_THRESHOLD, kLarge);
#endif
}

std::size_t peak_memory_since_last() {
    std::ifstream status("/proc/self/status");
    std::size_t kilobytes = 0;
    for (std::string word; status >> word;)
        if (word == "VmHWM:") status >> kilobytes;
    std::ofstream("/proc/self/clear_refs") << "5\n";  // its mark goes down to what is held now
    return kilobytes << 10;
}

int startable_threads(int wanted) {
    std::vector<std::thread> threads;
    std::latch end(1);
    try {
        while (static_cast<int>(threads.size()) + 1 < wanted) threads.emplace_back([&end] { end.wait(); });
    } catch (const std::system_error&) {  // the answer is how many there are
    }
    end.count_down();
    for (std::thread& t : threads) t.join();
    return static_cast<int>(threads.size()) + 1;
}

}  // namespace keyline::cli
