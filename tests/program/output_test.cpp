// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/program/program.h"

#include <csignal>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <map>
#include <sys/resource.h>

// What stands in the folder after a run that did not end well.

namespace keyline::test {

namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// Seconds of work, so that a signal surely comes in the middle of it.
constexpr const char* kSlow = R"(
    "c":    { "type": "constant", "color": [0.5, 0.25, 0], "size": [6000, 6000] },
    "blur": { "type": "gaussian", "in": "c", "sigma": 100 },
    "out":  { "type": "write", "in": "blur", "file": "out.exr" })";

class Outputs : public ProgramTest {
protected:
    // Renders until a frame is under way, then sends the signal.
    Outcome interrupt(int signal) const {
        Process process({"render", "graph.json", "--progress", "json", "--threads", "1"},
                        {.folder = folder()});
        EXPECT_TRUE(process.read_until("frame_started"));
        process.signal(signal);
        return process.wait();
    }
};

TEST_F(Outputs, SigintLeavesNothing) {
    graph(kSlow);
    const Outcome run = interrupt(SIGINT);
    EXPECT_EQ(run.status, 130) << run.err;
    EXPECT_THAT(run.err, HasSubstr(R"("signal": "SIGINT")"));
    EXPECT_THAT(files(), ElementsAre("graph.json"));
}

TEST_F(Outputs, SigtermLeavesNothing) {
    graph(kSlow);
    EXPECT_EQ(interrupt(SIGTERM).status, 143);
    EXPECT_THAT(files(), ElementsAre("graph.json"));
}

// A session that ends, or a terminal that is closed.
TEST_F(Outputs, SighupLeavesNothingAndSaysSo) {
    graph(kSlow);
    const Outcome run = interrupt(SIGHUP);
    EXPECT_EQ(run.status, 129) << run.err;
    EXPECT_THAT(run.err, HasSubstr(R"("signal": "SIGHUP")"));
    EXPECT_THAT(files(), ElementsAre("graph.json"));
}

TEST_F(Outputs, SigkillLeavesNothingUnderTheName) {
    graph(kSlow);
    write("out.exr", "what was there before");
    EXPECT_EQ(interrupt(SIGKILL).status, -SIGKILL);
    EXPECT_EQ(read(folder() / "out.exr"), "what was there before");
}

// A file that is opened as descriptor 2 gets the progress lines into its middle.
TEST_F(Outputs, NoClosedStreamLetsTextIntoAFile) {
    graph(R"("c": { "type": "constant", "color": [0.5, 0.25, 0], "size": [64, 64] },
             "a": { "type": "write", "in": "c", "file": "a.##.exr" },
             "b": { "type": "write", "in": "c", "file": "b.##.png" })");
    const std::vector<std::string> render{"render", "graph.json", "--frames", "1-6", "--progress", "lines"};
    ASSERT_EQ(keyline(render).status, 0);
    std::map<int, std::string> exr, png;
    for (int frame = 1; frame <= 6; ++frame) {
        exr[frame] = read(folder() / fmt::format("a.{:02}.exr", frame));
        png[frame] = read(folder() / fmt::format("b.{:02}.png", frame));
    }
    for (unsigned set = 1; set < 8; ++set) {
        RunOptions options;
        for (const int stream : {0, 1, 2})
            if ((set >> static_cast<unsigned>(stream) & 1U) != 0) options.closed.push_back(stream);
        SCOPED_TRACE(testing::PrintToString(options.closed));
        EXPECT_EQ(keyline(render, options).status, 0);
        for (int frame = 1; frame <= 6; ++frame) {
            EXPECT_EQ(read(folder() / fmt::format("a.{:02}.exr", frame)), exr[frame]) << frame;
            EXPECT_EQ(read(folder() / fmt::format("b.{:02}.png", frame)), png[frame]) << frame;
        }
    }
}

TEST_F(Outputs, AResultForAClosedStreamIsLostAloud) {
    const Outcome run = keyline({"nodes"}, {.closed = {1}});
    EXPECT_EQ(run.status, 4);
    EXPECT_THAT(run.err, HasSubstr("standard output"));
}

TEST_F(Outputs, AnIgnoredSignalStaysIgnored) {
    graph(R"("c": { "type": "constant", "color": [0, 0, 0], "size": [512, 512] },
             "out": { "type": "write", "in": "c", "file": "out.exr" })");
    const auto before = std::signal(SIGINT, SIG_IGN);
    Process process({"render", "graph.json", "--progress", "json"}, {.folder = folder()});
    std::signal(SIGINT, before);
    process.signal(SIGINT);
    EXPECT_EQ(process.wait().status, 0);
}

// Frame 1 is done long before frame 3000, and is then taken away.
TEST_F(Outputs, ARunEndsWellOnlyWhereAllIsThere) {
    graph(R"("c":    { "type": "constant", "color": [0.5, 0.25, 0], "size": ["${frame}", 3000] },
             "blur": { "type": "gaussian", "in": "c", "sigma": 100 },
             "out":  { "type": "write", "in": "blur", "file": "out/a.####.exr" })");
    Process process({"render", "graph.json", "--frames", "1,3000", "--progress", "lines", "--threads", "1"},
                    {.folder = folder()});
    ASSERT_TRUE(process.read_until("frame 1: done"));
    fs::remove(folder() / "out/a.0001.exr");
    const Outcome run = process.wait();
    EXPECT_EQ(run.status, 4);
    EXPECT_THAT(run.err, HasSubstr("a.0001.exr' was written and is not there"));
    EXPECT_THAT(run.err, HasSubstr("1 failed"));
}

TEST_F(Outputs, AnOlderFileStaysWhenARenderFails) {
    write("plate.exr", read(plates() / "street.0001.exr").substr(0, 200000));
    write("out.exr", "what was there before");
    graph(R"("r": { "type": "read", "file": "plate.exr" },
             "out": { "type": "write", "in": "r", "file": "out.exr" })");
    EXPECT_EQ(keyline({"render", "graph.json"}).status, 75);
    EXPECT_EQ(read(folder() / "out.exr"), "what was there before");
    EXPECT_THAT(files(), ElementsAre("graph.json", "out.exr", "plate.exr"));
}

TEST_F(Outputs, AFileThatMayNotGrowIsAnErrorOfTheOutput) {
    write("out.exr", "what was there before");
    graph(R"("r": { "type": "read", "file": ")" + (plates() / "street.0001.exr").string() + R"(" },
             "out": { "type": "write", "in": "r", "file": "out.exr" })");
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit little{64 << 10, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &little);
    Process process({"render", "graph.json"}, {.folder = folder()});
    setrlimit(RLIMIT_FSIZE, &before);
    const Outcome run = process.wait();
    EXPECT_EQ(run.status, 4) << run.err;
    EXPECT_THAT(run.err, HasSubstr("out.exr"));
    EXPECT_EQ(read(folder() / "out.exr"), "what was there before");
    EXPECT_THAT(files(), ElementsAre("graph.json", "out.exr"));
}

TEST_F(Outputs, AnOlderFileIsReplacedAndFoldersAreMade) {
    write("old/out.exr", "what was there before");
    graph(R"("c": { "type": "constant", "color": [0, 0, 0], "size": [4, 4] },
             "a": { "type": "write", "in": "c", "file": "old/out.exr" },
             "b": { "type": "write", "in": "c", "file": "new/deep/out.exr" })");
    EXPECT_EQ(keyline({"render", "graph.json"}).status, 0);
    EXPECT_EQ(keyline({"verify", "graph.json"}).out,
              "old/out.exr: current\nnew/deep/out.exr: current\n2 outputs: 2 current\n");
}

TEST_F(Outputs, ASymbolicLinkIsWrittenThrough) {
    fs::create_directory(folder() / "real");
    fs::create_symlink("real/out.exr", folder() / "out.exr");
    graph(R"("c": { "type": "constant", "color": [0, 0, 0], "size": [4, 4] },
             "out": { "type": "write", "in": "c", "file": "out.exr" })");
    EXPECT_EQ(keyline({"render", "graph.json"}).status, 0);
    EXPECT_TRUE(fs::is_symlink(folder() / "out.exr"));
    EXPECT_TRUE(fs::is_regular_file(folder() / "real/out.exr"));
}

TEST_F(Outputs, TwoNamesOfOneFileAreTwoWritesToIt) {
    fs::create_directory(folder() / "real");
    fs::create_directory_symlink("real", folder() / "link");
    graph(R"("c": { "type": "constant", "color": [0, 0, 0], "size": [4, 4] },
             "a": { "type": "write", "in": "c", "file": "real/out.exr" },
             "b": { "type": "write", "in": "c", "file": "link/../real/./out.exr" })");
    const Outcome run = keyline({"render", "graph.json"});
    EXPECT_EQ(run.status, 2);
    EXPECT_THAT(run.err, HasSubstr("is written by node 'a' (write) too"));
}

TEST_F(Outputs, AWriteOntoAnInputIsRefusedUnlessNothingReadsIt) {
    fs::copy(plates() / "street.0001.exr", folder() / "plate.exr");
    const std::string before = read(folder() / "plate.exr");
    graph(R"("r": { "type": "read", "file": "plate.exr" },
             "out": { "type": "write", "in": "r:Combined", "file": "./plate.exr" })");
    EXPECT_EQ(keyline({"render", "graph.json"}).status, 2);
    EXPECT_EQ(read(folder() / "plate.exr"), before);
    graph(R"("r": { "type": "read", "file": "plate.exr" },
             "c": { "type": "constant", "color": [0, 0, 0], "size": [4, 4] },
             "out": { "type": "write", "in": "c", "file": "plate.exr" })");
    EXPECT_EQ(keyline({"render", "graph.json"}).status, 0);
}

}  // namespace

}  // namespace keyline::test
