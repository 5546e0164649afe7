// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/output_file.h"

#include "engine/base/error.h"
#include "engine/io/image_sink.h"
#include "tests/io/exr_files.h"

#include <chrono>
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

struct stat status_of(const std::filesystem::path& file) {
    struct stat status = {};
    EXPECT_EQ(stat(file.c_str(), &status), 0) << file;
    return status;
}

unsigned mode_of(const std::filesystem::path& file) { return status_of(file).st_mode & 0777U; }

// As if nobody had written to it for so long.
void age(const std::filesystem::path& file, std::chrono::hours hours) {
    std::filesystem::last_write_time(file, std::filesystem::file_time_type::clock::now() - hours);
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
    EXPECT_EQ(mode_of(folder / "a.exr"), 0640U);
}

TEST_P(OutputFileTest, WhoSharesTheOlderFileGoesOnSharingIt) {
    write_file(folder / "a.exr", "old");
    ASSERT_EQ(chmod((folder / "a.exr").c_str(), 0664), 0);
    const bool may_give = geteuid() == 0;
    ASSERT_EQ(may_give ? chown((folder / "a.exr").c_str(), 1234, 2345) : 0, 0);
    const struct stat before = status_of(folder / "a.exr");
    OutputFile file(folder / "a.exr", GetParam());
    file.publish();
    const struct stat after = status_of(folder / "a.exr");
    EXPECT_EQ(after.st_size, 0);
    EXPECT_EQ(after.st_mode & 0777U, 0664U);
    EXPECT_EQ(after.st_uid, before.st_uid);
    EXPECT_EQ(after.st_gid, before.st_gid);
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

// Two that differ in their last letters only, at work at once.
TEST_P(OutputFileTest, NamesOfAnyLengthWork) {
    const std::string stem(250, 'n');
    OutputFile one(folder / (stem + "1.exr"), GetParam()), two(folder / (stem + "2.exr"), GetParam());
    one.append(bytes("one"));
    two.append(bytes("two"));
    two.publish();
    one.publish();
    EXPECT_THAT(folder.entries(), ElementsAre(stem + "1.exr", stem + "2.exr"));
    EXPECT_EQ(content(folder / (stem + "1.exr")), "one");
    EXPECT_EQ(content(folder / (stem + "2.exr")), "two");
}

// As two processes do that a split network made render the same frame.
TEST_P(OutputFileTest, OneOutputTwiceAtWorkIsWholeTwice) {
    OutputFile one(folder / "a.exr", GetParam()), two(folder / "a.exr", GetParam());
    one.append(bytes("one"));
    two.append(bytes("two, half"));
    one.publish();
    EXPECT_EQ(content(folder / "a.exr"), "one");
    two.append(bytes(" and whole"));
    two.publish();
    EXPECT_EQ(content(folder / "a.exr"), "two, half and whole");
    EXPECT_THAT(folder.entries(), ElementsAre("a.exr"));
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

// What another process is at work on is left alone, however old; so is what is called like it and is not
// ours.
TEST(RemoveLeftovers, NothingThatIsAtWork) {
    const TemporaryFolder folder;
    OutputFile file(folder / "a.exr", OutputFile::Unfinished::kNamed);
    file.append(bytes("half"));
    age(file.unfinished_path(), std::chrono::hours(100));
    for (const char* name : {".keyline", "keyline-1-2.exr", ".a.keyline-1.exr"})
        write_file(folder / name, "");
    remove_leftovers(folder / "b.exr");
    EXPECT_EQ(folder.entries().size(), 4U);
    file.publish();
    EXPECT_EQ(content(folder / "a.exr"), "half");
}

// Of another machine nothing is known but when it last wrote.
TEST(RemoveLeftovers, OfAnotherMachineAfterADay) {
    const TemporaryFolder folder;
    write_file(folder / ".keyline-elsewher-0123456789abcdef.exr", "");
    write_file(folder / ".keyline-elsewher-fedcba9876543210.exr", "");
    age(folder / ".keyline-elsewher-0123456789abcdef.exr", std::chrono::hours(23));
    age(folder / ".keyline-elsewher-fedcba9876543210.exr", std::chrono::hours(25));
    remove_leftovers(folder / "a.exr");
    EXPECT_THAT(folder.entries(), ElementsAre(".keyline-elsewher-0123456789abcdef.exr"));
    EXPECT_NO_THROW(remove_leftovers(folder / "not/there/a.exr"));
}

TEST(RemoveLeftovers, LooksBehindSymbolicLinks) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "real");
    std::filesystem::create_symlink("real/a.exr", folder / "link.exr");
    in_child([&] {
        const OutputFile file(folder / "real/a.exr", OutputFile::Unfinished::kNamed);
        kill(getpid(), SIGKILL);
    });
    ASSERT_FALSE(std::filesystem::is_empty(folder / "real"));
    remove_leftovers(folder / "link.exr");
    EXPECT_TRUE(std::filesystem::is_empty(folder / "real"));
}

}  // namespace
}  // namespace keyline
