// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/program/program.h"

#include <nlohmann/json.hpp>

// `plan --json` says what `plan` says.

namespace keyline::test {

namespace {

using Json = nlohmann::json;

class PlanAsJson : public ProgramTest {
protected:
    Json plan(const std::vector<std::string>& options) const {
        std::vector<std::string> arguments{"plan", "graph.json", "--json"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const Outcome run = keyline(arguments);
        EXPECT_EQ(run.status, 0) << run.err;
        return Json::parse(run.out);
    }
};

TEST_F(PlanAsJson, TellsWhatIsReadComputedAndWritten) {
    graph(R"("r":     { "type": "read", "file": ")" + (plates() / "street.####.exr").string() + R"(" },
             "y":     { "type": "ycolor", "in": "r:Combined" },
             "slope": { "type": "gradient", "in": "y" },
             "edges": { "type": "hysteresis", "in": "slope", "low": 0.1, "high": 0.3 },
             "out":   { "type": "write", "in": "edges", "file": "out.####.exr" })");
    const Json frames = plan({"--frames", "1-2", "--tile", "64", "--threads", "3"});
    ASSERT_EQ(frames.size(), 2U);
    EXPECT_EQ(frames.at(1).at("frame"), 2);
    const Json& frame = frames.at(0);
    EXPECT_EQ(frame.at("threads"), 3);
    const Json window = Json::parse(R"({ "x": 0, "y": 0, "width": 480, "height": 270 })");
    const Json& input = frame.at("inputs").at(0);
    EXPECT_EQ(input.at("region"), window);
    EXPECT_EQ(input.at("channels"), 22);
    EXPECT_EQ(input.at("reads").size(), 3U);
    EXPECT_EQ(frame.at("outputs").at(0).at("dataWindow"), window);
    ASSERT_EQ(frame.at("sweeps").size(), 2U);
    const Json& first = frame.at("sweeps").at(0);
    EXPECT_EQ(first.at("tiles"), 40);
    EXPECT_EQ(first.at("tileWidth"), 64);
    EXPECT_EQ(first.at("leaves").at(0).at("what"), "gather");
    EXPECT_GT(frame.at("memory"), 10 << 20);
    EXPECT_FALSE(exists("out.0001.exr"));
}

TEST_F(PlanAsJson, TellsTheChoices) {
    graph(R"("in": { "type": "constant", "color": [0.2, 0.5, 0.7], "size": [1920, 1080] },
             "it": { "type": "gaussian", "in": "in", "sigma": 30 },
             "out": { "type": "write", "in": "it", "file": "out.exr" })");
    const Json choices = plan({}).at(0).at("choices");
    ASSERT_GT(choices.size(), 2U);
    EXPECT_EQ(choices.front().at("time"), 1);
    EXPECT_EQ(choices.front().at("taken"), true);
    EXPECT_LT(choices.back().at("memory"), choices.front().at("memory"));
}

}  // namespace

}  // namespace keyline::test
