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
    EXPECT_THAT(without.err, HasSubstr("it depends on the frame; say which frames with --frames"));
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

TEST_F(Frames, DownwardsAndAsFarmsWriteThem) {
    graph(R"("c": { "type": "constant", "color": [0, 0, 0], "size": [4, 4] },
             "out": { "type": "write", "in": "c", "file": "out.#.exr" })");
    EXPECT_EQ(render("5-1:2").status, 0);
    EXPECT_THAT(files(), ElementsAre("graph.json", "out.1.exr", "out.3.exr", "out.5.exr"));
    EXPECT_EQ(render("7 - 8, 9").status, 0);
    EXPECT_TRUE(exists("out.9.exr"));
}

// Lists come from files and other programs, a frame or a range a line.
TEST_F(Frames, FromAFileAndFromStandardInput) {
    graph(R"("c": { "type": "constant", "color": [0, 0, 0], "size": [4, 4] },
             "out": { "type": "write", "in": "c", "file": "out.#.exr" })");
    write("list", "1-2\r\n\n 7 , 9\n");
    EXPECT_EQ(render("@list").status, 0);
    EXPECT_THAT(files(),
                ElementsAre("graph.json", "list", "out.1.exr", "out.2.exr", "out.7.exr", "out.9.exr"));
    EXPECT_EQ(keyline({"render", "graph.json", "--frames", "-"}, {.in = write("piped", "4:\n")}).status, 2);
    EXPECT_EQ(keyline({"render", "graph.json", "--frames", "-"}, {.in = write("piped", "4\n")}).status, 0);
    EXPECT_TRUE(exists("out.4.exr"));
    EXPECT_THAT(render("@nowhere").err,
                HasSubstr("--frames @nowhere: error: cannot read the list 'nowhere': "));
    const Outcome twice = keyline({"render", "-", "--frames", "-"}, {.in = folder() / "graph.json"});
    EXPECT_EQ(twice.status, 2);
    EXPECT_THAT(twice.err, HasSubstr("--frames -: error: the graph comes by standard input too"));
}

// What there is to do may be nothing; then nothing is done, and that is well.
TEST_F(Frames, AnEmptyListIsNoFrames) {
    graph(R"("c": { "type": "constant", "color": [0, 0, 0], "size": [4, 4] },
             "out": { "type": "write", "in": "c", "file": "out.#.exr" })");
    write("list", "\n");
    const Outcome run = render("@list");
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.err, "keyline: done frames=- retry=no reason=none\n");
    EXPECT_THAT(files(), ElementsAre("graph.json", "list"));
}

TEST_F(Frames, AllAreThoseOnDisk) {
    graph(R"("r":     { "type": "read", "file": "in/plate.####.exr" },
             "spare": { "type": "read", "file": "spare.####.exr" },
             "out":   { "type": "write", "in": "r:Combined", "file": "out.#.exr" })");
    EXPECT_THAT(render("all").err,
                HasSubstr("--frames all: error: no frame of what the graph reads was found"));
    for (const int frame : {3, 12}) plate(frame);
    fs::copy(plates() / "street.0001.exr", folder() / "spare.0099.exr");
    const Outcome run = render("all");
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_THAT(run.err, HasSubstr("keyline: done frames=3,12 "));
}

// The names of all are known from one or two of them: the first is begun at once.
TEST_F(Frames, AMillionFramesBeginAtOnce) {
    plate(1);
    graph(kSequence);
    Process process({"render", "graph.json", "--frames", "1-1000000", "--progress", "lines"},
                    {.folder = folder()});
    EXPECT_TRUE(process.read_until("frame 1: done"));
    EXPECT_EQ(process.wait().status, 3);  // frame 2 is not there
}

TEST_F(Frames, ASingleHashInAFolderIsTheFolders) {
    fs::create_directories(folder() / "take#1");
    fs::copy(plates() / "street.0001.exr", folder() / "take#1/plate.0001.exr");
    graph(R"("r":   { "type": "read", "file": "take#1/plate.####.exr" },
             "out": { "type": "write", "in": "r:Combined", "file": "out#/\\#.##/comp.####.exr" })");
    EXPECT_EQ(render("1").status, 0);
    EXPECT_TRUE(exists("out#/#.01/comp.0001.exr"));
    EXPECT_EQ(keyline({"render", "graph.json", "--frames", "1", "--output", "r=take#1/o.exr"}).status, 0);
    EXPECT_TRUE(exists("take#1/o.exr"));
}

// Taken as they stand, these would make files that nobody looks for.
TEST_F(Frames, NamesOfOtherProgramsAndSystemsAreRefused) {
    for (const char* name :
         {"~/out.exr", "$SHOW/out.exr", "out.$F4.exr", "out.@@@@.exr", "out.%V.exr", R"(D:\\show\\out.exr)",
          "D:/show/out.exr", R"(\\\\server\\out.exr)", R"(show\\out.exr)", R"(out\u0000.exr)"}) {
        SCOPED_TRACE(name);
        graph(fmt::format(R"("c": {{ "type": "constant", "color": [0, 0, 0], "size": [4, 4] }},
                             "out": {{ "type": "write", "in": "c", "file": "{}" }})",
                          name));
        for (const char* command : {"check", "plan", "render"}) {
            const Outcome run = keyline({command, "graph.json"});
            EXPECT_EQ(run.status, 2) << run.err;
            EXPECT_THAT(run.err, HasSubstr("graph.json:3:"));
        }
        EXPECT_THAT(files(), ElementsAre("graph.json"));
    }
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

TEST_F(Frames, FramesThatWereNotTriedAreNamed) {
    for (const int frame : {1, 3, 4}) plate(frame);
    graph(kSequence);
    const Outcome run = render("1-4,9", {"--threads", "1"});
    EXPECT_EQ(run.status, 3);
    EXPECT_THAT(run.err, HasSubstr("1 of 5 frames done, 0 skipped, 1 failed"));
    EXPECT_THAT(run.err, HasSubstr("not tried: 3, 4, 9\n"));
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
