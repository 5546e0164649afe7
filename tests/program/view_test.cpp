// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/io/exr_files.h"
#include "tests/program/program.h"
#include "tests/support/image.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

// keyline view: pictures of nodes.

namespace keyline::test {

namespace {

using keyline::testing::Image;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class View : public ProgramTest {
protected:
    View() {
        graph(R"("c":    { "type": "constant", "color": [0.2, 0.5, 0], "size": [32, 16] },
                 "dot":  { "type": "constant", "color": [1, 1, 1, 1], "size": [8, 8] },
                 "comp": { "type": "over", "fg": "dot", "bg": "c" },
                 "show": { "type": "display", "in": "comp" },
                 "out":  { "type": "write", "in": "show", "file": "out.exr" })");
    }
    Outcome view(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), {"view", "graph.json"});
        return keyline(arguments);
    }
    Image picture(const std::string& name) const { return keyline::testing::read_exr(folder() / name); }
};

TEST_F(View, OfColourIsThroughTheDisplayOnce) {
    for (const char* node : {"comp", "show"}) {
        const Outcome run = view({node, "-o", fmt::format("{}.exr", node)});
        EXPECT_EQ(run.status, 0) << run.err;
        EXPECT_EQ(run.out + run.err, "");
    }
    EXPECT_EQ(keyline({"diff", "comp.exr", "show.exr", "--tolerance", "0.001"}).status, 0);
    EXPECT_FALSE(exists("out.exr"));
}

TEST_F(View, ChannelsAndRanges) {
    EXPECT_EQ(view({"c", "--channel", "G", "--range", "0,1", "-o", "g.exr"}).status, 0);
    EXPECT_EQ(picture("g.exr").at("R", 3, 3), 0.5F);
    EXPECT_EQ(view({"c:R", "--range", "0.1,0.3", "-o", "r.exr"}).status, 0);
    EXPECT_NEAR(double{picture("r.exr").at("B", 3, 3)}, 0.5, 0.001);
}

TEST_F(View, SeveralNodesMakeASheet) {
    EXPECT_EQ(view({"-o", "sheet.exr"}).status, 0);
    EXPECT_EQ(picture("sheet.exr").display, (Rect{0, 0, 2 * 332 + 12, 2 * 216 + 12}));
    EXPECT_EQ(view({"c", "comp", "-o", "two.png"}).status, 0);
    EXPECT_THAT(keyline({"info", "two.png"}).out,
                HasSubstr("676 × 228 at (0, 0), 3 channels\n  R G B uint8"));
}

// The dot covers 8 × 8 pixels of 'comp'; 'c' is the same without it.
TEST_F(View, TwoNodesInOnePicture) {
    EXPECT_EQ(view({"comp", "c", "--compare", "wipe", "-o", "wipe.exr"}).status, 0);
    EXPECT_EQ(view({"c", "comp", "--compare", "wipe", "-o", "other.exr"}).status, 0);
    EXPECT_EQ(view({"c", "-o", "c.exr"}).status, 0);
    const Image wipe = picture("wipe.exr"), other = picture("other.exr"), c = picture("c.exr");
    EXPECT_GT(wipe.at("R", 3, 3), c.at("R", 3, 3));
    EXPECT_EQ(other.at("R", 3, 3), c.at("R", 3, 3));
    EXPECT_EQ(wipe.at("R", 20, 3), c.at("R", 20, 3));
    EXPECT_EQ(wipe.at("R", 15, 3), 1.0F) << "the line between them";

    EXPECT_EQ(view({"c", "comp", "--compare", "difference", "-o", "apart.exr"}).status, 0);
    EXPECT_GT(picture("apart.exr").at("R", 3, 3), 0.0F);
    EXPECT_EQ(picture("apart.exr").at("R", 20, 12), 0.0F);
    EXPECT_EQ(view({"c", "--compare", "wipe", "-o", "x.exr"}).err,
              "--compare wipe: error: it takes two nodes\n");
    EXPECT_EQ(view({"c", "comp", "--compare", "flip", "-o", "x.exr"}).err,
              "--compare flip: error: it must be wipe or difference\n");
}

TEST_F(View, PixelsOfARegionAreLargeAndApart) {
    EXPECT_EQ(view({"comp", "--pixel-grid", "6,0,4,2", "-o", "grid.exr"}).status, 0);
    EXPECT_EQ(view({"comp", "-o", "comp.exr"}).status, 0);
    const Image grid = picture("grid.exr"), comp = picture("comp.exr");
    EXPECT_EQ(grid.display, (Rect{0, 0, 256, 128}));
    for (const int x : {6, 7, 8, 9}) EXPECT_EQ(grid.at("R", (x - 6) * 64 + 32, 32), comp.at("R", x, 0)) << x;
    EXPECT_LT(grid.at("R", 64, 32), comp.at("R", 6, 0));
    EXPECT_EQ(view({"comp", "--pixel-grid", "6,0,4", "-o", "x.exr"}).err,
              "--pixel-grid 6,0,4: error: it must be X,Y,WIDTH,HEIGHT\n");
}

TEST_F(View, StrokesAreDrawn) {
    graph(R"("p": { "type": "read", "file": ")" + (plates() / "street.0001.exr").string() + R"(" },
             "lines": { "type": "contours", "in": "p", "layer": "CryptoObject" })");
    const Outcome run = view({"lines", "-o", "lines.exr"});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(picture("lines.exr").display, (Rect{0, 0, 480, 270}));
}

TEST_F(View, InTheTerminalOfEachKind) {
    const std::string blocks = view({"c", "--as", "blocks"}).out;
    EXPECT_THAT(blocks, StartsWith("\x1b[38;2;"));
    EXPECT_THAT(blocks, HasSubstr("\u2580"));
    EXPECT_THAT(view({"c", "--as", "kitty"}).out, StartsWith("\x1b_Ga=T,f=100,m=1;iVBORw0KGgo"));
    EXPECT_THAT(view({"c", "--as", "iterm"}).out, StartsWith("\x1b]1337;File=inline=1;size="));
    EXPECT_THAT(view({"c", "--as", "sixel"}).out, StartsWith("\x1bPq\"1;1;"));
    const Outcome run = view({"c", "--as", "paper"});
    EXPECT_EQ(run.status, 2);
    EXPECT_EQ(run.err, "--as paper: error: it must be kitty, iterm, sixel or blocks\n");
}

TEST_F(View, WithoutATerminalAFileIsWanted) {
    const Outcome run = view({"c"});
    EXPECT_EQ(run.status, 2);
    EXPECT_THAT(run.err, HasSubstr("give a file with -o"));
}

// A command's name is a node's name too.
TEST_F(View, ANodeMayBeCalledAsACommandIs) {
    graph(R"("render": { "type": "constant", "color": [0.2, 0.5, 0], "size": [32, 16] })");
    EXPECT_EQ(view({"render", "-o", "x.exr"}).status, 0);
}

TEST_F(View, WhatIsWrongIsTold) {
    EXPECT_THAT(view({"cmp", "-o", "x.exr"}).err, HasSubstr("there is no node 'cmp'; did you mean 'comp'?"));
    EXPECT_THAT(view({"out", "-o", "x.exr"}).err, HasSubstr("gives nothing to be seen"));
    EXPECT_THAT(view({"c", "--range", "1", "-o", "x.exr"}).err,
                HasSubstr("--range 1: error: it must be auto, or A,B"));
    const Outcome layer = view({"c:Q", "-o", "x.exr"});
    EXPECT_EQ(layer.status, 2);
    EXPECT_THAT(layer.err, StartsWith("error: no layer or channel 'Q'"));
    EXPECT_THAT(layer.err, Not(HasSubstr("picture/")));
    graph(R"("c": { "type": "constant", "color": [0.2, 0.5, 0], "sise": [32, 16] })");
    const Outcome run = view({"c", "-o", "x.exr"});
    EXPECT_EQ(run.status, 2);
    EXPECT_THAT(run.err, HasSubstr("unknown key 'sise'"));
    EXPECT_THAT(run.err, Not(HasSubstr("picture/")));
}

}  // namespace

}  // namespace keyline::test
