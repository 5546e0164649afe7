// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/program/program.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

// check, plan and render find the same faults; and what one file is that goes by two names.

namespace keyline::test {

namespace {

using testing::HasSubstr;

constexpr const char* kConstant =
    R"("c": { "type": "constant", "color": [0.5, 0.25, 0], "size": [32, 16] },)";

constexpr int kMayNot = 77;  // of a process that lacks the right to play its part

class Checks : public ProgramTest {
protected:
    void plate(const std::string& name) const {
        fs::create_directories((folder() / name).parent_path());
        fs::copy(plates() / "street.0001.exr", folder() / name);
    }

    // All three say so, in the same words.
    void expect_all(int status, const std::string& text, const std::vector<std::string>& options = {}) const {
        for (const char* command : {"check", "plan", "render"}) {
            SCOPED_TRACE(command);
            std::vector<std::string> arguments{command, "graph.json"};
            arguments.insert(arguments.end(), options.begin(), options.end());
            const Outcome run = keyline(arguments);
            EXPECT_EQ(run.status, status) << run.err;
            EXPECT_EQ(run.out, "");
            EXPECT_THAT(run.err, HasSubstr(text));
        }
    }
};

TEST_F(Checks, ALaterFrameReadsWhatAnEarlierOneWrites) {
    for (const int frame : {0, 1, 2}) plate(fmt::format("in/plate.{:04}.exr", frame));
    graph(R"("r":   { "type": "read", "file": "in/plate.####.exr", "frame": "-1" },
             "out": { "type": "write", "in": "r:Combined", "file": "in/plate.####.exr" })");
    expect_all(2, "is read by frame 2 of this run", {"--frames", "1-2"});
}

TEST_F(Checks, SeveralFramesIntoOneFile) {
    graph(std::string(kConstant) + R"("out": { "type": "write", "in": "c", "file": "out.exr" })");
    expect_all(2, "frames 1-3 would all be written to", {"--frames", "1-3"});
}

TEST_F(Checks, AFormatThatCantHoldIt) {
    graph(
        std::string(kConstant) +
        R"("out": { "type": "write", "in": "c", "file": "out.jpg", "channels": ["R", "G", "B"], "depth": "half" })");
    expect_all(2, "has no depth 'half'");
}

TEST_F(Checks, APlaceThatCantBeWrittenTo) {
    write("file", "a file, not a folder");
    fs::create_directory(folder() / "folder.exr");
    ASSERT_EQ(mkfifo((folder() / "pipe.exr").c_str(), 0600), 0);
    for (const auto& [name, why] :
         {std::pair("file/out.exr", "Not a directory"), std::pair("file/new/out.exr", "Not a directory"),
          std::pair("folder.exr", "Is a directory"), std::pair("pipe.exr", "not a regular file")}) {
        graph(kConstant + fmt::format(R"("out": {{ "type": "write", "in": "c", "file": "{}" }})", name));
        expect_all(4, why);
    }
}

// The superuser may write anything but what is mounted to be read only.
TEST_F(Checks, AFolderWithoutPermission) {
    graph(std::string(kConstant) + R"("out": { "type": "write", "in": "c", "file": "shut/out.exr" })");
    fs::create_directory(folder() / "shut");
    fs::permissions(folder() / "shut", fs::perms(0555));
    fs::permissions(folder(), fs::perms(0755));
    const pid_t child = fork();
    if (child == 0) {
        if (geteuid() == 0 && setuid(65534) != 0) _exit(1);
        if (access(KEYLINE_PROGRAM, X_OK) != 0) _exit(kMayNot);
        for (const char* command : {"check", "plan", "render"}) {
            const Outcome run = keyline({command, "graph.json"});
            if (run.status != 4 || run.err.find("Permission denied") == std::string::npos) _exit(2);
        }
        _exit(0);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    if (WEXITSTATUS(status) == kMayNot) GTEST_SKIP() << "another user may not run the program";
    EXPECT_EQ(status, 0);
}

TEST_F(Checks, AFolderThatIsMountedTwiceHidesNoPlate) {
    plate("a/plate.0001.exr");
    fs::create_directory(folder() / "b");
    const std::string before = read(folder() / "a/plate.0001.exr");
    graph(R"("r":   { "type": "read", "file": "a/plate.####.exr" },
             "out": { "type": "write", "in": "r:Combined", "file": "b/plate.####.exr" })");
    const pid_t child = fork();
    if (child == 0) {
        if (unshare(CLONE_NEWNS) != 0 || mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
            mount((folder() / "a").c_str(), (folder() / "b").c_str(), nullptr, MS_BIND, nullptr) != 0)
            _exit(kMayNot);
        _exit(keyline({"render", "graph.json", "--frames", "1"}).status);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    if (WEXITSTATUS(status) == kMayNot) GTEST_SKIP() << "this process may mount nothing";
    EXPECT_EQ(WEXITSTATUS(status), 2);
    EXPECT_EQ(read(folder() / "a/plate.0001.exr"), before);
}

// Whichever of the two is the link, and whether the link is the frame's own or another's.
TEST_F(Checks, ALinkHidesNoPlate) {
    for (const int frame : {1, 2}) plate(fmt::format("in/plate.{:04}.exr", frame));
    const std::string before = read(folder() / "in/plate.0002.exr");
    fs::create_directory(folder() / "out");
    fs::create_symlink("../in/plate.0002.exr", folder() / "out/comp.0001.exr");
    graph(R"("r":   { "type": "read", "file": "in/plate.####.exr" },
             "out": { "type": "write", "in": "r:Combined", "file": "out/comp.####.exr" })");
    expect_all(2, "is read by frame 2 of this run", {"--frames", "1-2"});
    EXPECT_EQ(read(folder() / "in/plate.0002.exr"), before);
    fs::remove(folder() / "out/comp.0001.exr");
    fs::rename(folder() / "in/plate.0002.exr", folder() / "out/comp.0001.exr");
    fs::create_symlink("../out/comp.0001.exr", folder() / "in/plate.0002.exr");
    expect_all(2, "is read by frame 2 of this run", {"--frames", "1-2"});
    EXPECT_EQ(read(folder() / "out/comp.0001.exr"), before);
}

// An output takes its place; the file that stood there keeps its other name and what it holds.
TEST_F(Checks, AHardLinkOfAPlateIsNoPlate) {
    plate("plate.exr");
    fs::create_hard_link(folder() / "plate.exr", folder() / "out.exr");
    const std::string before = read(folder() / "plate.exr");
    graph(R"("r":   { "type": "read", "file": "plate.exr" },
             "out": { "type": "write", "in": "r:Normal", "file": "out.exr" })");
    EXPECT_EQ(keyline({"render", "graph.json"}).status, 0);
    EXPECT_EQ(read(folder() / "plate.exr"), before);
}

// A file that is being copied opens like any other; its table of chunks tells.
TEST_F(Checks, AnInputThatIsNotFinished) {
    const std::string whole = read(plates() / "street.0001.exr");
    graph(R"("r":   { "type": "read", "file": "plate.exr" },
             "out": { "type": "write", "in": "r:Combined", "file": "out.exr" })");
    for (const double share : {0.05, 0.5, 0.99}) {
        write("plate.exr", whole.substr(0, static_cast<std::size_t>(share * double(whole.size()))));
        expect_all(75, "plate.exr: the file is not finished");
        const Outcome info = keyline({"info", "plate.exr"});
        EXPECT_EQ(info.status, 75);
        EXPECT_THAT(info.out, HasSubstr("480 × 270"));
        EXPECT_THAT(info.err, HasSubstr("the file is not finished"));
    }
    EXPECT_FALSE(exists("out.exr"));
}

}  // namespace

}  // namespace keyline::test
