// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/program/program.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

// Frames: which are run, and what a failed one does to the others.

namespace keyline::test {

namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kSequence = R"(
    "r":   { "type": "read", "file": "in/plate.####.exr" },
    "out": { "type": "write", "in": "r:Combined", "file": "out/####/comp.%04d.exr" })";

class Frames : public ProgramTest {
protected:
    void plate(int frame) const {
        fs::create_directories(folder() / "in");
        fs::copy(plates() / "street.0001.exr", folder() / fmt::format("in/plate.{:04}.exr", frame));
    }
    Outcome render(const std::string& frames, std::vector<std::string> more = {}) const {
        more.insert(more.begin(), {"render", "graph.json", "--frames=" + frames});
        return keyline(more);
    }
};

TEST_F(Frames, TokensStandInFoldersAndNames) {
    for (const int frame : {1, 2, 3}) plate(frame);
    graph(kSequence);
    const Outcome run = render("1-3x2");
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_TRUE(exists("out/0001/comp.0001.exr"));
    EXPECT_FALSE(exists("out/0002/comp.0002.exr"));
    EXPECT_TRUE(exists("out/0003/comp.0003.exr"));
}

TEST_F(Frames, NegativeFrames) {
    graph(R"("c": { "type": "constant", "color": [0, 0, 0], "size": [4, 4] },
             "out": { "type": "write", "in": "c", "file": "out.##.exr" })");
    EXPECT_EQ(render("-1-1").status, 0);
    EXPECT_THAT(files(), ElementsAre("graph.json", "out.-01.exr", "out.00.exr", "out.01.exr"));
}

TEST_F(Frames, InTheOrderGivenAndEachOnce) {
    graph(R"("c": { "type": "constant", "color": [0, 0, 0], "size": [4, 4] },
             "out": { "type": "write", "in": "c", "file": "out.#.exr" })");
    const Outcome run = render("3,1,3", {"--progress", "json"});
    EXPECT_EQ(run.status, 0);
    EXPECT_LT(run.err.find(R"("outputs": ["out.3.exr"])"), run.err.find(R"("outputs": ["out.1.exr"])"));
    EXPECT_THAT(run.err, HasSubstr(R"("done": 2)"));
}

TEST_F(Frames, TheFrameAsAParameterNeedsFramesToo) {
    graph(R"("c": { "type": "constant", "color": [0, 0, 0], "size": ["${frame}", 4] },
             "out": { "type": "write", "in": "c", "file": "out.exr" })");
    const Outcome without = keyline({"render", "graph.json"});
    EXPECT_EQ(without.status, 2);
    EXPECT_THAT(without.err, HasSubstr("${frame}"));
    EXPECT_EQ(render("7").status, 0);
    EXPECT_THAT(keyline({"info", "out.exr"}).out, HasSubstr("7 × 4"));
}

TEST_F(Frames, AFrameThatIsNotUsedAsksForNoFrames) {
    graph(R"("c": { "type": "constant", "color": [0, 0, 0], "size": [4, 4] },
             "spare": { "type": "read", "file": "in.####.exr" },
             "out": { "type": "write", "in": "c", "file": "out.exr" })");
    EXPECT_EQ(keyline({"render", "graph.json"}).status, 0);
}

TEST_F(Frames, SeveralFramesIntoOneFileAreRefused) {
    graph(R"("c": { "type": "constant", "color": [0, 0, 0], "size": [4, 4] },
             "out": { "type": "write", "in": "c", "file": "out.exr" })");
    const Outcome run = render("1-2");
    EXPECT_EQ(run.status, 2);
    EXPECT_THAT(run.err, HasSubstr("node 'out' (write)"));
    EXPECT_THAT(files(), ElementsAre("graph.json"));
}

TEST_F(Frames, AFailedFrameEndsTheRun) {
    for (const int frame : {1, 3}) plate(frame);
    graph(kSequence);
    const Outcome run = render("1-3");
    EXPECT_EQ(run.status, 3);
    EXPECT_THAT(run.err, HasSubstr("plate.0002.exr"));
    EXPECT_TRUE(exists("out/0001/comp.0001.exr"));
    EXPECT_FALSE(exists("out/0003/comp.0003.exr"));
}

TEST_F(Frames, KeepGoingRendersTheOthers) {
    for (const int frame : {1, 3}) plate(frame);
    graph(kSequence);
    const Outcome run = render("1-3", {"--keep-going"});
    EXPECT_EQ(run.status, 3);
    EXPECT_TRUE(exists("out/0001/comp.0001.exr"));
    EXPECT_TRUE(exists("out/0003/comp.0003.exr"));
}

TEST_F(Frames, TheFirstFrameMayBeTheMissingOne) {
    plate(2);
    graph(kSequence);
    const Outcome run = render("1-2", {"--keep-going"});
    EXPECT_EQ(run.status, 3);
    EXPECT_TRUE(exists("out/0002/comp.0002.exr"));
}

TEST_F(Frames, ALayerMissingInALaterFrameFailsThatFrame) {
    plate(1);
    graph(R"("c": { "type": "constant", "color": [0, 0, 0], "size": [4, 4] },
             "out": { "type": "write", "in": "c", "file": "in/plate.0002.exr" })");
    ASSERT_EQ(keyline({"render", "graph.json"}).status, 0);
    graph(kSequence);
    const Outcome run = render("1-2");
    EXPECT_EQ(run.status, 3) << run.err;
    EXPECT_THAT(run.err, HasSubstr("Combined"));
    EXPECT_TRUE(exists("out/0001/comp.0001.exr"));
}

TEST_F(Frames, HeldAndBlackFramesAreWarnedOf) {
    plate(1);
    graph(R"("r":   { "type": "read", "file": "in/plate.####.exr", "missing": "hold" },
             "out": { "type": "write", "in": "r:Combined", "file": "out.#.exr" })");
    const Outcome run = render("1-2");
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_THAT(run.err, HasSubstr("warning: node 'r' (read)"));
    EXPECT_THAT(run.err, testing::Not(HasSubstr("error:")));
}

TEST_F(Frames, SkipExistingLeavesFinishedOutputsAlone) {
    plate(1);
    plate(2);
    graph(kSequence);
    ASSERT_EQ(render("1").status, 0);
    const auto before = fs::last_write_time(folder() / "out/0001/comp.0001.exr");
    const Outcome run = render("1-2", {"--skip-existing", "--progress", "lines"});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_THAT(run.err, HasSubstr("frame 1: skipped"));
    EXPECT_THAT(run.err, HasSubstr("frame 2: done"));
    EXPECT_EQ(fs::last_write_time(folder() / "out/0001/comp.0001.exr"), before);
}

TEST_F(Frames, SkipExistingRendersWhatIsNotAsPlanned) {
    plate(1);
    graph(kSequence);
    write("out/0001/comp.0001.exr", "cut off");
    EXPECT_EQ(render("1", {"--skip-existing"}).status, 0);
    EXPECT_THAT(keyline({"info", "out/0001/comp.0001.exr"}).out, HasSubstr("R G B A half"));
    EXPECT_EQ(render("1", {"--skip-existing", "--set", "out.in=r:Normal"}).status, 0);
    EXPECT_THAT(keyline({"info", "out/0001/comp.0001.exr"}).out, HasSubstr("X Y Z"));
}

// Frame 1 reads a frame 0 that is not there: what frames 2 and 3 read must not be written all the same.
TEST_F(Frames, AFrameThatFailsHidesNoneThatReadsWhatAnotherWrites) {
    for (const int frame : {1, 2, 3}) plate(frame);
    graph(R"("r":   { "type": "read", "file": "in/plate.####.exr", "frame": "-1" },
             "out": { "type": "write", "in": "r:Combined", "file": "in/plate.####.exr" })");
    const std::string before = read(folder() / "in/plate.0002.exr");
    for (const char* frames : {"1-3", "1"}) {
        const Outcome run = render(frames, {"--keep-going"});
        EXPECT_NE(run.status, 0) << run.err;
        EXPECT_EQ(read(folder() / "in/plate.0002.exr"), before);
    }
}

TEST_F(Frames, NoFrameReadsWhatAnotherWrites) {
    for (const int frame : {0, 1, 2}) plate(frame);
    graph(R"("r":   { "type": "read", "file": "in/plate.####.exr", "frame": "-1" },
             "out": { "type": "write", "in": "r:Combined", "file": "in/plate.####.exr" })");
    const std::string before = read(folder() / "in/plate.0001.exr");
    const Outcome run = render("1-2");
    EXPECT_EQ(run.status, 2);
    EXPECT_THAT(run.err, HasSubstr("is read by frame 2 of this run"));
    EXPECT_EQ(read(folder() / "in/plate.0001.exr"), before);
}

}  // namespace

}  // namespace keyline::test
