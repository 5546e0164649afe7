// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/output_file.h"

#include "engine/error.h"
#include "engine/io/image_sink.h"
#include "tests/io/exr_files.h"

#include <csignal>
#include <fmt/format.h>
#include <fstream>
#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace keyline {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Unfinished = OutputFile::Unfinished;

std::span<const std::byte> bytes(const std::string& text) { return std::as_bytes(std::span(text)); }

std::string content(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

void write_file(const std::filesystem::path& file, const std::string& text) { std::ofstream(file) << text; }

std::string failure_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.error().kind, ErrorKind::kOutput) << failure.what();
        return failure.what();
    }
    ADD_FAILURE() << "nothing failed";
    return "";
}

std::string unfinished_name(const std::string& stem, pid_t process) {
    std::array<char, 256> host = {};
    gethostname(host.data(), host.size());
    return fmt::format(".{}.{}.{}.keyline.exr", stem, host.data(), process);
}

// Runs `action` in a process of its own; returns how that ended (see waitpid).
int in_child(const std::function<void()>& action) {
    const pid_t child = fork();
    if (child == 0) {
        action();
        _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return status;
}

pid_t dead_process() {
    const pid_t child = fork();
    if (child == 0) _exit(0);
    waitpid(child, nullptr, 0);
    return child;
}

class OutputFileTest : public testing::TestWithParam<Unfinished> {
protected:
    TemporaryFolder folder;
};

TEST_P(OutputFileTest, AppearsOnlyWhenPublished) {
    OutputFile file(folder / "a.exr", GetParam());
    file.append(bytes("hello world"));
    file.overwrite(6, bytes("there"));
    EXPECT_FALSE(std::filesystem::exists(folder / "a.exr"));
    file.publish();
    EXPECT_THAT(folder.entries(), ElementsAre("a.exr"));
    EXPECT_EQ(content(folder / "a.exr"), "hello there");
}

TEST_P(OutputFileTest, DestroyedBeforeLeavesNothing) {
    { OutputFile(folder / "a.exr", GetParam()).append(bytes("x")); }
    EXPECT_THAT(folder.entries(), IsEmpty());
}

TEST_P(OutputFileTest, TheOlderFileStaysUntilTheRename) {
    write_file(folder / "a.exr", "old");
    {
        OutputFile file(folder / "a.exr", GetParam());
        file.append(bytes("new"));
        EXPECT_EQ(content(folder / "a.exr"), "old");
    }
    EXPECT_EQ(content(folder / "a.exr"), "old");
    OutputFile file(folder / "a.exr", GetParam());
    file.append(bytes("new"));
    file.publish();
    EXPECT_EQ(content(folder / "a.exr"), "new");
    EXPECT_THAT(folder.entries(), ElementsAre("a.exr"));
}

TEST_P(OutputFileTest, ModeFollowsTheUmask) {
    const mode_t before = umask(027);
    OutputFile file(folder / "a.exr", GetParam());
    file.publish();
    umask(before);
    struct stat status = {};
    ASSERT_EQ(stat((folder / "a.exr").c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777U, 0640U);
}

TEST_P(OutputFileTest, WritesThroughSymbolicLinks) {
    std::filesystem::create_directory(folder / "real");
    write_file(folder / "real/a.exr", "old");
    std::filesystem::create_symlink("real/a.exr", folder / "link.exr");
    std::filesystem::create_symlink("link.exr", folder / "twice.exr");
    std::filesystem::create_symlink("real/new.exr", folder / "dangling.exr");
    for (const char* name : {"twice.exr", "dangling.exr"}) {
        OutputFile file(folder / name, GetParam());
        file.append(bytes("new"));
        file.publish();
        EXPECT_TRUE(std::filesystem::is_symlink(folder / name));
    }
    EXPECT_EQ(content(folder / "real/a.exr"), "new");
    EXPECT_EQ(content(folder / "real/new.exr"), "new");
}

TEST_P(OutputFileTest, MakesMissingFolders) {
    OutputFile file(folder / "x/y/a.exr", GetParam());
    file.publish();
    EXPECT_TRUE(std::filesystem::exists(folder / "x/y/a.exr"));
}

TEST_P(OutputFileTest, SaysWhatTheSystemSays) {
    write_file(folder / "file", "");
    std::filesystem::create_directory(folder / "folder.exr");
    ASSERT_EQ(mkfifo((folder / "pipe.exr").c_str(), 0600), 0);
    std::filesystem::create_symlink("loop.exr", folder / "loop.exr");
    const auto open = [&](const std::string& name) {
        return failure_of([&] { OutputFile(folder / name, GetParam()); });
    };
    EXPECT_THAT(open("file/a.exr"), HasSubstr("file/a.exr: can't be written: "));
    EXPECT_THAT(open("folder.exr"), HasSubstr("Is a directory"));
    EXPECT_THAT(open("pipe.exr"), HasSubstr("not a regular file"));
    EXPECT_THAT(open("loop.exr"), HasSubstr("Too many levels of symbolic links"));
    EXPECT_THAT(open(std::string(255, 'n') + "/a.exr/" + std::string(300, 'n')),
                HasSubstr("File name too long"));
}

TEST_P(OutputFileTest, AFullDiskIsAnError) {
    const int status = in_child([&] {
        signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{1000, 1000};
        setrlimit(RLIMIT_FSIZE, &limit);
        const std::string why = failure_of([&] {
            OutputFile file(folder / "a.exr", GetParam());
            file.append(bytes(std::string(2000, 'x')));
        });
        _exit(why.find("a.exr: can't be written: File too large") == std::string::npos ? 1 : 0);
    });
    EXPECT_EQ(status, 0);
    EXPECT_THAT(folder.entries(), IsEmpty());
}

TEST_P(OutputFileTest, NamesOfAnyLengthWork) {
    const std::string name = std::string(251, 'n') + ".exr";
    OutputFile file(folder / name, GetParam());
    file.publish();
    EXPECT_THAT(folder.entries(), ElementsAre(name));
}

INSTANTIATE_TEST_SUITE_P(Unnamed, OutputFileTest, testing::Values(Unfinished::kUnnamedWherePossible));
INSTANTIATE_TEST_SUITE_P(Named, OutputFileTest, testing::Values(Unfinished::kNamed));

// In a process that is not the superuser's, who may write anything.
TEST(OutputFile, ReadOnlyFilesAreNotReplaced) {
    const TemporaryFolder folder;
    write_file(folder / "a.exr", "old");
    std::filesystem::permissions(folder / "a.exr", std::filesystem::perms(0444));
    std::filesystem::permissions(folder.path(), std::filesystem::perms(0777));
    const int status = in_child([&] {
        if (geteuid() == 0 && setuid(65534) != 0) _exit(2);
        const std::string why = failure_of([&] { OutputFile(folder / "a.exr"); });
        _exit(why.find("Permission denied") == std::string::npos ? 1 : 0);
    });
    EXPECT_EQ(status, 0);
    EXPECT_EQ(content(folder / "a.exr"), "old");
}

// Killed while a sink writes: without a name there is nothing left, with one it is told apart and removed.
TEST(OutputFile, AKilledProcessLeavesNothingThatStays) {
    const TemporaryFolder folder;
    write_file(folder / "a.exr", "old");
    const auto write_and_die = [&](Unfinished unfinished) {
        return in_child([&] {
            OutputFile file(folder / "a.exr", unfinished);
            file.append(bytes(std::string(100000, 'x')));
            kill(getpid(), SIGKILL);
        });
    };
    EXPECT_TRUE(WIFSIGNALED(write_and_die(Unfinished::kUnnamedWherePossible)));
    EXPECT_THAT(folder.entries(), ElementsAre("a.exr"));
    EXPECT_TRUE(WIFSIGNALED(write_and_die(Unfinished::kNamed)));
    EXPECT_EQ(folder.entries().size(), 2U);
    remove_leftovers(folder / "a.exr");
    EXPECT_THAT(folder.entries(), ElementsAre("a.exr"));
    EXPECT_EQ(content(folder / "a.exr"), "old");
}

TEST(OutputFile, AKilledRenderLeavesNothing) {
    const TemporaryFolder folder;
    const int status = in_child([&] {
        SinkSpec spec;
        spec.display_window = spec.data_window = {0, 0, 64, 64};
        spec.channels = {{"R"}};
        Pixels pixels(SampleType::kHalf, spec.data_window);
        const std::vector<Plane> planes = {pixels.plane()};
        const auto sink = create_image(folder / "a.exr", spec);
        sink->commit(sink->encode(0, planes));
        kill(getpid(), SIGKILL);
    });
    EXPECT_TRUE(WIFSIGNALED(status));
    EXPECT_THAT(folder.entries(), IsEmpty());
}

TEST(RemoveLeftovers, OnlyOfThisOutputAndOfDeadProcessesOfThisHost) {
    const TemporaryFolder folder;
    const pid_t dead = dead_process();
    const std::string leftover = unfinished_name("a", dead);
    const std::vector<std::string> others = {unfinished_name("a", getppid()), unfinished_name("b", dead),
                                             fmt::format(".a.elsewhere.{}.keyline.exr", dead),
                                             unfinished_name("a", dead) + "x", "a.exr"};
    write_file(folder / leftover, "");
    for (const std::string& name : others) write_file(folder / name, "");
    remove_leftovers(folder / "a.exr");
    EXPECT_THAT(folder.entries(), testing::UnorderedElementsAreArray(others));
    EXPECT_NO_THROW(remove_leftovers(folder / "not/there/a.exr"));
}

TEST(RemoveLeftovers, LooksBehindSymbolicLinks) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "real");
    std::filesystem::create_symlink("real/a.exr", folder / "link.exr");
    write_file(folder / "real" / unfinished_name("a", dead_process()), "");
    remove_leftovers(folder / "link.exr");
    EXPECT_TRUE(std::filesystem::is_empty(folder / "real"));
}

}  // namespace
}  // namespace keyline
