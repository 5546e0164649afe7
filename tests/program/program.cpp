// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/program/program.h"

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <fmt/format.h>
#include <fstream>
#include <spawn.h>
#include <sstream>
#include <stdexcept>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

namespace keyline::test {

namespace {

void check(int error, const char* what) {
    if (error != 0) throw std::system_error(error, std::generic_category(), what);
}

fs::path temporary_folder() {
    std::string name = (fs::temp_directory_path() / "keyline-test-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) check(errno, "mkdtemp");
    return fs::canonical(name);
}

std::string read_file(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
    std::vector<char*> out;
    for (std::string& t : texts) out.push_back(t.data());
    out.push_back(nullptr);
    return out;
}

// The tests' own environment without what the program looks at, behind what is set: of two the first counts.
std::vector<std::string> environment_with(const std::vector<std::string>& more) {
    std::vector<std::string> out = more;
    for (char** e = environ; *e != nullptr; ++e)
        if (!std::string_view(*e).starts_with("OCIO")) out.emplace_back(*e);
    return out;
}

}  // namespace

Process::Process(const std::vector<std::string>& arguments, const RunOptions& options) : out_(options.out) {
    if (out_.empty()) {
        std::string name = (fs::temp_directory_path() / "keyline-out-XXXXXX").string();
        close(mkstemp(name.data()));
        out_ = name;
        own_out_ = true;
    }
    std::array<int, 2> err = {};
    if (pipe2(err.data(), O_CLOEXEC) != 0) check(errno, "pipe");
    posix_spawn_file_actions_t actions;
    check(posix_spawn_file_actions_init(&actions), "posix_spawn");
    check(posix_spawn_file_actions_addchdir_np(&actions, options.folder.c_str()), "chdir");
    check(posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out_.c_str(), O_WRONLY, 0), "stdout");
    check(posix_spawn_file_actions_adddup2(&actions, err[1], STDERR_FILENO), "stderr");
    if (!options.in.empty())
        check(posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, options.in.c_str(), O_RDONLY, 0),
              "stdin");
    for (const int stream : options.closed)
        check(posix_spawn_file_actions_addclose(&actions, stream), "close");
    std::vector<std::string> all, environment = environment_with(options.environment);
    if (!options.through.empty()) all.push_back(options.through.string());
    all.emplace_back(KEYLINE_PROGRAM);
    all.insert(all.end(), arguments.begin(), arguments.end());
    check(posix_spawn(&pid_, all[0].c_str(), &actions, nullptr, pointers(all).data(),
                      pointers(environment).data()),
          "posix_spawn");
    posix_spawn_file_actions_destroy(&actions);
    close(err[1]);
    err_ = err[0];
}

Process::~Process() {
    if (pid_ > 0) {
        kill(pid_, SIGKILL);
        waitpid(pid_, nullptr, 0);
    }
    close_standard_error();
    if (own_out_) fs::remove(out_);
}

std::string Process::read_some() {
    std::array<char, 4096> buffer = {};
    const ssize_t n = err_ < 0 ? 0 : ::read(err_, buffer.data(), buffer.size());
    return {buffer.data(), static_cast<std::size_t>(std::max<ssize_t>(n, 0))};
}

bool Process::read_until(std::string_view text) {
    while (read_.find(text) == std::string::npos) {
        const std::string more = read_some();
        if (more.empty()) return false;
        read_ += more;
    }
    return true;
}

void Process::signal(int signal) const { kill(pid_, signal); }

void Process::close_standard_error() {
    if (err_ >= 0) close(err_);
    err_ = -1;
}

Outcome Process::wait() {
    for (std::string more = read_some(); !more.empty(); more = read_some()) read_ += more;
    int status = 0;
    if (waitpid(pid_, &status, 0) != pid_) check(errno, "waitpid");
    pid_ = -1;
    return {WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status),
            own_out_ ? read_file(out_) : std::string(), read_};
}

fs::path plates() { return KEYLINE_PLATES; }

ProgramTest::ProgramTest() : folder_(temporary_folder()) {}

ProgramTest::~ProgramTest() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
}

Outcome ProgramTest::keyline(const std::vector<std::string>& arguments, RunOptions options) const {
    if (options.folder.empty()) options.folder = folder_;
    return Process(arguments, options).wait();
}

fs::path ProgramTest::write(const std::string& name, std::string_view text) const {
    const fs::path file = folder_ / name;
    fs::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
    return file;
}

std::string ProgramTest::read(const fs::path& file) { return read_file(file); }

std::vector<std::string> ProgramTest::files() const {
    std::vector<std::string> out;
    for (const auto& entry : fs::recursive_directory_iterator(folder_))
        if (!entry.is_directory()) out.push_back(fs::relative(entry.path(), folder_).string());
    std::ranges::sort(out);
    return out;
}

fs::path ProgramTest::graph(std::string_view nodes, std::string_view top) const {
    return write("graph.json", fmt::format("{{ \"keyline\": 1, {} \"nodes\": {{\n{}\n}} }}\n", top, nodes));
}

}  // namespace keyline::test
