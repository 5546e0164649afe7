// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/machine.h"

#include <algorithm>
#include <climits>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <functional>
#include <optional>
#include <sched.h>
#include <sstream>
#include <string>
#include <thread>
#include <unistd.h>

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

int available_cores() {
    cpu_set_t set;
    CPU_ZERO(&set);
    const bool known = sched_getaffinity(0, sizeof set, &set) == 0;
    const int cores = known ? CPU_COUNT(&set) : static_cast<int>(std::thread::hardware_concurrency());
    return std::max(1, std::min(cores, control_group_cores("/")));
}

std::size_t available_memory() {
    const auto pages = static_cast<std::size_t>(sysconf(_SC_PHYS_PAGES));
    const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    return std::min(pages * page, control_group_memory("/"));
}

}  // namespace keyline::cli
