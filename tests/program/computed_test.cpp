// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/program/program.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

// Graphs whose values are expressions and keys, and nodes that are not enabled.

namespace keyline::test {

namespace {

using testing::HasSubstr;

class Computed : public ProgramTest {
protected:
    // What `plan` says of frames, with the parameters of a gaussian on an image of 40 × 20.
    void blur(const std::string& sigma, const std::string& top = "") const {
        graph(fmt::format(R"("c": {{ "type": "constant", "color": [1, 0.5, 0], "size": [40, 20] }},
                             "wide": {{ "type": "crop", "in": "c", "region": [10, 5, 10, 10] }},
                             "blur": {{ "type": "gaussian", "in": "wide", "sigma": {} }},
                             "out": {{ "type": "write", "in": "blur", "file": "####.exr" }})",
                          sigma),
              top);
    }
    // The bytes of a frame, rendered by itself.
    std::string frame(int number) const {
        const Outcome run = keyline({"render", "graph.json", "--no-provenance", "--progress", "none",
                                     fmt::format("--frames={}", number)});
        EXPECT_EQ(run.status, 0) << run.err;
        return read(folder() / fmt::format("{:04}.exr", number));
    }
    std::string frame_of(int number, const std::string& sigma, const std::string& top = "") const {
        blur(sigma, top);
        return frame(number);
    }
};

TEST_F(Computed, AnExpressionIsTheNumberThatItComesTo) {
    const std::string two = frame_of(7, "2");
    EXPECT_NE(two, frame_of(7, "3"));
    EXPECT_EQ(two, frame_of(7, R"("= 1 + 1")"));
    EXPECT_EQ(two, frame_of(7, R"("= frame - 5")"));
    EXPECT_EQ(two, frame_of(7, R"(["= 2", "= 4 / 2"])"));
    EXPECT_EQ(two, frame_of(7, R"("= k ^ 1")", R"("variables": { "k": 2 },)"));
    EXPECT_EQ(two, frame_of(7, R"("${k}")", R"("variables": { "k": "= j / 2", "j": "= 4" },)"));
    EXPECT_EQ(two, frame_of(7, R"("= frame - first")", R"("frames": "5-9",)"));
    EXPECT_EQ(two, frame_of(7, R"("= fps / 12")", R"("fps": 24,)"));
}

TEST_F(Computed, AnExpressionKnowsTheLeadingInput) {
    const std::string two = frame_of(7, "2");
    EXPECT_EQ(two, frame_of(7, R"("= width / height")"));
    EXPECT_EQ(two, frame_of(7, R"("= data.x / data.y")"));
    EXPECT_EQ(two, frame_of(7, R"("= data.width - 8")"));
    EXPECT_EQ(two, frame_of(7, R"("= 2 * pixel_aspect + x + y")"));
    EXPECT_EQ(two, frame_of(7, R"("${s}")", R"("variables": { "s": "= k * height", "k": 0.1 },)"));
}

TEST_F(Computed, KeysAreTheValueOfTheirFrame) {
    const std::string keys = R"({ "keys": [[1, 1], [5, 5, "hold"], [9, 2]] })";
    EXPECT_EQ(frame_of(2, "2"), frame_of(2, keys));
    EXPECT_EQ(frame_of(8, "5"), frame_of(8, keys));
    EXPECT_EQ(frame_of(3, "3"), frame_of(3, R"("${s}")", R"("variables": { "s": )" + keys + "},"));
    EXPECT_EQ(frame_of(4, "3"), frame_of(4, R"({ "keys": [[1, "= 2 - 1"], [5, "${s}"]], "on": 2 })",
                                         R"("variables": { "s": 5 },)"));
}

TEST_F(Computed, FramesOfOneRunHaveTheirOwnValues) {
    blur(R"("= frame")");
    EXPECT_EQ(
        keyline({"render", "graph.json", "--no-provenance", "--progress", "none", "--frames", "1-3"}).status,
        0);
    for (int i = 1; i <= 3; ++i) {
        const std::string together = read(folder() / fmt::format("{:04}.exr", i));
        EXPECT_EQ(together, frame_of(i, fmt::format("{}", i))) << i;
    }
}

TEST_F(Computed, WhatDependsOnSizesIsCheckedWhenTheyAreKnown) {
    blur(R"("= height * 100")");
    EXPECT_THAT(keyline({"check", "graph.json"}).err,
                HasSubstr("node 'blur' (gaussian): 'sigma' is 2000; it must be from 0 to 500 pixels"));
    blur(R"("= hieght * 100")");
    EXPECT_THAT(keyline({"check", "graph.json"}).err,
                HasSubstr("node 'blur' (gaussian): unknown name 'hieght'; did you mean 'height'?"));
}

class Enabled : public ProgramTest {
protected:
    std::string pixels(const std::string& enabled, const std::string& frames = "1") const {
        graph(fmt::format(R"("c": {{ "type": "constant", "color": [1, 0.5, 0], "size": [40, 20] }},
                 "a": {{ "type": "crop", "in": "c", "region": [10, 5, 10, 10] }},
                 "none": {{ "type": "read", "file": "nowhere.exr" }},
                 "blur": {{ "type": "over", "fg": "none", "bg": "a"{} }},
                 "out": {{ "type": "write", "in": "blur", "file": "####.exr" }})",
                          enabled));
        const Outcome run =
            keyline({"render", "graph.json", "--no-provenance", "--progress", "none", "--frames", frames});
        return run.status == 0 ? read(folder() / "0001.exr") : run.err;
    }
};

TEST_F(Enabled, ANodeThatIsNotPassesItsLeadingInputOnAndReadsNothingElse) {
    const std::string passed = pixels(R"(, "enabled": false)");
    EXPECT_THAT(pixels(""), HasSubstr("nowhere.exr"));
    EXPECT_EQ(passed, pixels(R"(, "enabled": "= frame > 1")"));
    graph(R"("c": { "type": "constant", "color": [1, 0.5, 0], "size": [40, 20] },
             "a": { "type": "crop", "in": "c", "region": [10, 5, 10, 10] },
             "out": { "type": "write", "in": "a", "file": "####.exr" })");
    EXPECT_EQ(
        keyline({"render", "graph.json", "--no-provenance", "--progress", "none", "--frames", "1"}).status,
        0);
    EXPECT_EQ(passed, read(folder() / "0001.exr"));
}

TEST_F(Enabled, AWriteThatIsNotWritesNothing) {
    graph(R"("c": { "type": "constant", "color": [1, 0.5, 0], "size": [8, 8] },
             "a": { "type": "write", "in": "c", "file": "same.exr", "enabled": false },
             "b": { "type": "write", "in": "c", "file": "same.exr" },
             "odd": { "type": "write", "in": "c", "file": "odd.####.exr", "enabled": "= frame % 2 == 1" },
             "d": { "type": "write", "in": "c", "file": "d.####.exr" })");
    const Outcome run = keyline({"render", "graph.json", "--no-provenance", "--progress", "none", "--frames",
                                 "1,2", "--only", "odd", "--only", "d", "--only", "a"});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_TRUE(exists("odd.0001.exr"));
    EXPECT_FALSE(exists("odd.0002.exr"));
    EXPECT_TRUE(exists("d.0002.exr"));
    EXPECT_FALSE(exists("same.exr"));
    EXPECT_EQ(keyline({"render", "graph.json", "--no-provenance", "--progress", "none", "--frames", "2",
                       "--only", "odd"})
                  .status,
              0)
        << "a frame may write nothing";
}

}  // namespace

}  // namespace keyline::test
