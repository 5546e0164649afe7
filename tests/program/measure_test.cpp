// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/program/program.h"

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
