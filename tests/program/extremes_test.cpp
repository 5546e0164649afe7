// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/program/program.h"

#include <gmock/gmock.h>

// Windows and options as large as they can be said: told before the first pixel, and no work for what is not
// seen.

namespace keyline::test {

namespace {

using ::testing::HasSubstr;

class Extremes : public ProgramTest {
protected:
    // One node of an image of 32 × 32, written to `file`.
    fs::path one(const std::string& node, const std::string& file = "out.exr") const {
        return graph(R"("in": { "type": "constant", "color": [0.5, 0.5, 0.5], "size": [32, 32] },
                        "it": )" +
                     node + R"(, "out": { "type": "write", "in": "it", "file": ")" + file + "\" }");
    }

    void expect_told(const std::string& status_2_says) const {
        for (const char* command : {"check", "plan", "render"}) {
            const Outcome run = keyline({command, "graph.json"});
            EXPECT_EQ(run.status, 2) << command << ": " << run.err;
            EXPECT_THAT(run.err, HasSubstr(status_2_says)) << command;
        }
        EXPECT_FALSE(exists("out.exr"));
    }
};

TEST_F(Extremes, WhatNoDiskHoldsIsRefusedBeforehand) {
    one(R"({ "type": "constant", "color": [0.5, 0.5, 0.5], "size": [1048576, 1048576] })");
    expect_told("node 'out' (write): 1048576 × 1048576 pixels are 8 TiB of samples");
}

TEST_F(Extremes, WhatIsFarLargerThanTheDisplayIsWarnedOf) {
    one(R"({ "type": "transform", "in": "in", "scale": 1000 })");
    for (const char* command : {"check", "plan"}) {
        const Outcome run = keyline({command, "graph.json"});
        EXPECT_EQ(run.status, 0) << run.err;
        EXPECT_THAT(run.err, HasSubstr("pixels are computed and written, of which 32 × 32 are displayed; "
                                       "a crop before it leaves out what is not seen"))
            << command;
    }
}

TEST_F(Extremes, WhatIsCroppedIsNotComputed) {
    graph(R"("in": { "type": "constant", "color": [0.5, 0.5, 0.5], "size": [32, 32] },
             "it": { "type": "transform", "in": "in", "scale": 1000 },
             "seen": { "type": "crop", "in": "it", "region": [0, 0, 32, 32] },
             "out": { "type": "write", "in": "seen", "file": "out.exr" })");
    const Outcome run = keyline({"render", "graph.json", "--progress", "none"});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.err, "keyline: done frames=1 retry=no reason=none\n");
    EXPECT_TRUE(exists("out.exr"));
}

// A format without windows holds what is displayed: a thousand million pixels around it would be computed and
// thrown away.
TEST_F(Extremes, WhatAFormatDoesNotHoldIsNotComputed) {
    one(R"({ "type": "transform", "in": "in", "scale": 1000 })", "out.png");
    const Outcome plan = keyline({"plan", "graph.json"});
    EXPECT_EQ(plan.err, "");
    EXPECT_THAT(plan.out, HasSubstr("sweep 1 of 1: 32 × 32 at (0, 0)"));
    const Outcome run = keyline({"render", "graph.json", "--progress", "none"});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_TRUE(exists("out.png"));
}

TEST_F(Extremes, AWindowThatCanNotBeCountedIsRefused) {
    std::string nodes = R"("n0": { "type": "constant", "color": [0.5, 0.5, 0.5], "size": [32, 32] })";
    for (int i = 1; i <= 540; ++i)
        nodes += ",\n\"n" + std::to_string(i) +
                 R"(": { "type": "transform", "translate": [1000000, -1000000], "in": "n)" +
                 std::to_string(i - 1) + "\" }";
    graph(nodes + R"(, "out": { "type": "write", "in": "n540", "file": "out.exr" })");
    expect_told("(transform): the picture would reach beyond pixel ±536870912");
}

TEST_F(Extremes, AWindowFarLargerThanTheFormatIsRefused) {
    graph(R"("in": { "type": "constant", "color": [0.5, 0.5, 0.5], "size": [2, 2] },
             "wide": { "type": "transform", "in": "in", "scale": [1000, 1] },
             "it": { "type": "reformat", "in": "wide", "size": [1048576, 1048576] },
             "seen": { "type": "crop", "in": "it", "region": [0, 0, 32, 32] },
             "out": { "type": "write", "in": "seen", "file": "out.exr" })");
    expect_told("(reformat): the picture would");
}

TEST_F(Extremes, TheLargestTileAndTheMostThreads) {
    one(R"({ "type": "gaussian", "in": "in", "sigma": 500 })");
    const Outcome plan = keyline({"plan", "graph.json", "--tile", "1048576", "--threads", "1024"});
    EXPECT_THAT(plan.out, HasSubstr("1 tile of 1048576 × 1048576"));
    EXPECT_EQ(plan.status, 0) << plan.err;
    EXPECT_EQ(keyline({"render", "graph.json", "--tile", "1048576"}).status, 0);
}

// The data window's corners are as far out as a file may say.
TEST_F(Extremes, PicturesFarOffTheOrigin) {
    one(R"({ "type": "transform", "in": "in", "translate": [-1000000, 1000000] })");
    ASSERT_EQ(keyline({"render", "graph.json"}).status, 0);
    graph(R"("in": { "type": "read", "file": "out.exr" },
             "it": { "type": "gaussian", "in": "in", "sigma": 3 },
             "back": { "type": "transform", "in": "it", "translate": [1000000, -1000000] },
             "out": { "type": "write", "in": "back", "file": "back.exr" })");
    const Outcome run = keyline({"render", "graph.json", "--tile", "7", "--progress", "none"});
    EXPECT_EQ(run.status, 0) << run.err;
}

}  // namespace

}  // namespace keyline::test
