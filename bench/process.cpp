// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/process.h"

#include <algorithm>
#include <chrono>
#include <fcntl.h>
#include <spawn.h>
#include <stdexcept>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace keyline::bench {

namespace {

pid_t start(const std::vector<std::string>& command) {
    std::vector<char*> argv;
    for (const std::string& s : command) argv.push_back(const_cast<char*>(s.c_str()));
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    pid_t child = 0;
    const int failed = posix_spawnp(&child, argv[0], &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (failed != 0) throw std::runtime_error("cannot run " + command[0]);
    return child;
}

// Bytes resident, at most.
std::size_t await(pid_t child, const std::string& name) {
    int status = 0;
    rusage usage{};
    wait4(child, &status, 0, &usage);
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) throw std::runtime_error(name + " failed");
    return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

}  // namespace

Measured run_process(const std::vector<std::string>& command) { return run_together({command}); }

Measured run_together(const std::vector<std::vector<std::string>>& commands) {
    const auto begin = std::chrono::steady_clock::now();
    std::vector<pid_t> children;
    for (const auto& command : commands) children.push_back(start(command));
    std::size_t peak = 0;
    for (std::size_t i = 0; i < children.size(); ++i)
        peak = std::max(peak, await(children[i], commands[i][0]));
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
    return {time.count(), peak};
}

}  // namespace keyline::bench
