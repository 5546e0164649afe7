// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <gtest/gtest.h>
#include <string>
#include <string_view>
#include <sys/types.h>
#include <vector>

// Whole runs of the program `keyline`.

namespace keyline::test {

namespace fs = std::filesystem;

struct Outcome {
    int status = -1;  // the exit status; minus the signal where one ended it
    std::string out, err;
};

struct RunOptions {
    fs::path folder = {};                       // the working directory; empty: the test's own
    std::vector<std::string> environment = {};  // NAME=VALUE, beside what there is
    fs::path out = {};                          // where standard output goes; empty: into Outcome::out
    fs::path in = {};                           // what standard input is; empty: the tests' own
    std::vector<int> closed = {};               // of the descriptors 0, 1 and 2
    fs::path through = {};                      // a program that runs it, with its own path and arguments
};

// A process under way.
class Process {
public:
    Process(const std::vector<std::string>& arguments, const RunOptions& options);
    ~Process();  // kills it where it was not waited for
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    // Reads standard error up to a line that holds `text`; false where it ended without.
    bool read_until(std::string_view text);
    void signal(int signal) const;
    void close_standard_error();
    Outcome wait();

private:
    std::string read_some();

    fs::path out_;
    bool own_out_ = false;
    int err_ = -1;
    pid_t pid_ = -1;
    std::string read_;
};

// The plates that lie in the repository: street.0001.exr and street.0002.exr, 480 × 270.
fs::path plates();

// Each test has a fresh folder of its own, which is gone afterwards.
class ProgramTest : public testing::Test {
protected:
    ProgramTest();
    ~ProgramTest() override;

    const fs::path& folder() const { return folder_; }
    Outcome keyline(const std::vector<std::string>& arguments, RunOptions options = {}) const;

    // A file in the folder, folders above it made.
    fs::path write(const std::string& name, std::string_view text) const;
    static std::string read(const fs::path& file);
    bool exists(const std::string& name) const { return fs::exists(folder_ / name); }

    // Everything in the folder, sorted, as names from there; hidden files too.
    std::vector<std::string> files() const;

    // A graph with these nodes (the text between the braces).
    fs::path graph(std::string_view nodes, std::string_view top = "") const;

private:
    fs::path folder_;
};

}  // namespace keyline::test
