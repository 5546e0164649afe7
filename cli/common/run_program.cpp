// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/common/run_program.h"

#include "engine/base/error.h"

#include <array>
#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

namespace keyline::cli {

namespace {

[[noreturn]] void fail_to_start(const std::string& program, int error) {
    fail(ErrorKind::kFailed,
         fmt::format("{} can't be started: {}", program, std::generic_category().message(error)),
         error == ENOENT ? "is it installed, and in $PATH?" : "");
}

// The text as a file to be read from its start.
int file_of(const std::string& text) {
    const int file = memfd_create("keyline", MFD_CLOEXEC);
    for (std::size_t done = 0; file >= 0 && done < text.size();) {
        const ssize_t n = write(file, text.data() + done, text.size() - done);
        if (n < 0) break;
        done += static_cast<std::size_t>(n);
    }
    lseek(file, 0, SEEK_SET);
    return file;
}

std::string read_to_end(int pipe) {
    std::string out;
    std::array<char, 4096> buffer = {};
    for (ssize_t n = 1; n > 0;) {
        n = read(pipe, buffer.data(), buffer.size());
        if (n < 0 && errno == EINTR) n = 1;
        if (n > 0) out.append(buffer.data(), static_cast<std::size_t>(n));
    }
    return out;
}

}  // namespace

ProgramResult run_program(const std::vector<std::string>& arguments, const std::string& in) {
    std::array<int, 2> out = {};
    if (pipe2(out.data(), O_CLOEXEC) != 0) fail_to_start(arguments.front(), errno);
    const int text = file_of(in);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, text, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, out[1], STDOUT_FILENO);
    std::vector<std::string> all = arguments;
    std::vector<char*> pointers;
    for (std::string& a : all) pointers.push_back(a.data());
    pointers.push_back(nullptr);
    pid_t process = 0;
    const int error = posix_spawnp(&process, pointers.front(), &actions, nullptr, pointers.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    close(out[1]);
    close(text);
    ProgramResult result;
    if (error == 0) result.out = read_to_end(out[0]);
    close(out[0]);
    if (error != 0) fail_to_start(arguments.front(), error);
    int status = 0;
    while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    result.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return result;
}

std::string own_program() { return std::filesystem::read_symlink("/proc/self/exe").string(); }

}  // namespace keyline::cli
