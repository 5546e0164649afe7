// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/program/program.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

// How good a drawing is, as the program tells it.

namespace keyline::test {

namespace {

using testing::HasSubstr;
using Json = nlohmann::json;

class Measure : public ProgramTest {
protected:
    Measure() {
        write("drawn.json", drawing(R"({ "kind": "outline", "points": [[10, 10.25], [70, 10.25]] })"));
        write("true.json", drawing(R"({ "kind": "fold", "points": [[30, 10], [90, 10]] })"));
    }
    static std::string drawing(const std::string& lines) {
        return R"({ "strokes": 1, "display": [0, 0, 100, 100], "window": [0, 0, 100, 100],
                    "lines": [)" +
               lines + "] }";
    }
};

TEST_F(Measure, TellsPeopleInTables) {
    const Outcome run = keyline({"measure", "drawn.json", "true.json"});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.out, R"(drawn.json
  against true.json, within 1 pixels and 30 degrees
    drawn        pixels    % true    off rms    robust      95 %      bias
    outline              60      66.7     0.250     0.371     0.250    -0.250
    all                  60      66.7     0.250     0.371     0.250    -0.250
    true         pixels   % drawn
    fold                 60      66.7
    all                  60      66.7
    precision 0.667, recall 0.667, F 0.667
  in itself
    strokes          1 of 2 vertices, 60 pixels
    doubles          0.0 %
    loose ends       2 of 2, 33.3 in 1000 pixels
    closed outlines  0 of 0 objects wholly in view
    ripple           0.000 pixels
    width            changes by 0.000 a pixel at most (95 %), spreads by 0.0 %
    curves           1, 1.7 in 100 pixels
)");
}

TEST_F(Measure, TellsProgramsInJson) {
    const Outcome run = keyline({"measure", "drawn.json", "true.json", "--json"});
    ASSERT_EQ(run.status, 0) << run.err;
    const Json told = Json::parse(run.out);
    EXPECT_NEAR(told["accuracy"]["precision"], 2.0 / 3, 1e-6);
    EXPECT_EQ(told["accuracy"]["true"][0]["kind"], "fold");
    EXPECT_EQ(told["form"]["looseEnds"], 2);
    EXPECT_FALSE(Json::parse(keyline({"measure", "drawn.json", "--json"}).out).contains("accuracy"));
}

TEST_F(Measure, WritesWhatIsExtraAndWhatIsMissed) {
    const Outcome run =
        keyline({"measure", "drawn.json", "true.json", "--extra", "extra.json", "--missed", "missed.json"});
    ASSERT_EQ(run.status, 0) << run.err;
    const Json extra = Json::parse(read(folder() / "extra.json"))["lines"][0];
    EXPECT_EQ(extra["kind"], "outline");
    EXPECT_NEAR(extra["points"].back()[0], 30, 0.5);
    EXPECT_NEAR(Json::parse(read(folder() / "missed.json"))["lines"][0]["points"][0][0], 70, 0.5);
}

// Two frames, in which everything goes 2 pixels to the right and the line 0.25 down.
class MeasureFrames : public Measure {
protected:
    MeasureFrames() {
        write("line.1.json", drawing(R"({ "points": [[10, 10], [70, 10]], "width": 2 })"));
        write("line.2.json", drawing(R"({ "points": [[12, 10.25], [72, 10.25]], "width": 2 })"));
        graph(R"("grey": { "type": "constant", "color": [-2, 0, -2, 0], "size": [100, 100] },
                 "motion": { "type": "shuffle", "in": "grey",
                             "channels": { "X": "R", "Y": "G", "Z": "B", "W": "A" } },
                 "out": { "type": "write", "in": "grey", "layers": { "view.Vector": "motion" },
                          "file": "motion.#.exr" })");
        EXPECT_EQ(keyline({"render", "graph.json", "--frames", "1-2"}).status, 0);
    }
};

TEST_F(MeasureFrames, TellsWhatIsSteady) {
    const Outcome run =
        keyline({"measure", "line.#.json", "--frames", "1-2", "--vector", "motion.#.exr:Vector"});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.out, R"(line.#.json, frames 1-2, as motion.#.exr:Vector has them move
    looked for       120 pixels in 1 pairs of frames
    swim             0.371 pixels, rms 0.250, at most 0.250 (95 %)
    pops             0.00 %, flecks 0.00 %
    lost ink         0.00 %
    drift            0.250 pixels from frame to frame, 0.250 from the first to the last, of 60 that stay in view
)");
    const Outcome json =
        keyline({"measure", "line.#.json", "--frames", "1-2", "--vector", "motion.#.exr", "--json"});
    EXPECT_EQ(Json::parse(json.out)["pairs"], 1);
    EXPECT_NEAR(Json::parse(json.out)["swimRms"], 0.25, 1e-6);
}

TEST_F(MeasureFrames, HoldsPicturesOfThemAgainstEachOther) {
    graph(R"("in": { "type": "strokes_read", "file": "line.#.json" },
             "ink": { "type": "draw", "in": "in" },
             "out": { "type": "write", "in": "ink", "file": "ink.#.exr", "depth": "float" })");
    ASSERT_EQ(keyline({"render", "graph.json", "--frames", "1-2"}).status, 0);
    const Outcome one = keyline({"measure", "line.1.json", "--drawn", "ink.1.exr"});
    EXPECT_THAT(one.out, HasSubstr("drawn width      spreads by 0.0 %, told from 40 pixels")) << one.err;
    EXPECT_NEAR(Json::parse(keyline({"measure", "line.1.json", "--drawn", "ink.1.exr", "--json"})
                                .out)["form"]["drawnWidthSpread"],
                0, 1e-4);
    // By a quarter of a pixel down, of 2: a quarter goes above, a quarter comes below.
    const std::vector<std::string> two{"measure",  "line.#.json",  "--frames", "1-2",
                                       "--vector", "motion.#.exr", "--drawn",  "ink.#.exr"};
    const Outcome run = keyline(two);
    EXPECT_THAT(run.out, HasSubstr("flicker          22.")) << run.out << run.err;
    write("rgb.json", R"({ "keyline": 1, "nodes": {
        "in": { "type": "constant", "color": [1, 1, 1], "size": [9, 9] },
        "out": { "type": "write", "in": "in", "channels": ["R", "G", "B"], "file": "rgb.exr" } } })");
    ASSERT_EQ(keyline({"render", "rgb.json"}).status, 0);
    EXPECT_THAT(keyline({"measure", "line.1.json", "--drawn", "rgb.exr"}).err,
                HasSubstr("rgb.exr: it has no channel A, and not just one channel; write what 'draw' gives"));
}

TEST_F(MeasureFrames, FaultsAreTold) {
    const auto told = [&](std::vector<std::string> more) {
        more.insert(more.begin(), {"measure", "line.#.json"});
        const Outcome run = keyline(more);
        return fmt::format("{} {}", run.status, run.err);
    };
    EXPECT_THAT(told({"--frames", "1-2"}), HasSubstr("2 error: frames are held against each other"));
    EXPECT_THAT(told({"--frames", "1", "--vector", "motion.#.exr"}),
                HasSubstr("2 error: one frame has no other"));
    EXPECT_THAT(told({"true.json", "--frames", "1-2", "--vector", "motion.#.exr"}),
                HasSubstr("2 error: a truth is for one frame"));
    EXPECT_THAT(told({"--frames", "1-2", "--vector", "motion.#.exr:Speed"}),
                HasSubstr("motion.1.exr: it has no channel Speed.X; name the layer"));
    EXPECT_THAT(told({"--frames", "1-3", "--vector", "motion.#.exr"}),
                HasSubstr("line.3.json: no such file"));
}

TEST_F(Measure, FaultsAreTold) {
    const Outcome no_truth = keyline({"measure", "drawn.json", "--missed", "missed.json"});
    EXPECT_EQ(no_truth.status, 2);
    EXPECT_THAT(no_truth.err, HasSubstr("what is extra or missed shows against a truth; give its file too"));
    const Outcome no_file = keyline({"measure", "other.json"});
    EXPECT_EQ(no_file.status, 3);
    EXPECT_THAT(no_file.err, HasSubstr("other.json: no such file"));
    EXPECT_EQ(keyline({"measure", "drawn.json", "true.json", "--within", "-1"}).status, 2);
}

}  // namespace

}  // namespace keyline::test
