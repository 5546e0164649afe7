// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/program/program.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <sstream>

// What a render says while it runs.

namespace keyline::test {

namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char* kNodes = R"(
    "c":   { "type": "constant", "color": [0, 0, 0], "size": [16, 16] },
    "spare": { "type": "gaussian", "in": "c" },
    "out": { "type": "write", "in": "c", "file": "out.#.exr" })";

class Progress : public ProgramTest {
protected:
    Outcome render(const std::string& mode) const {
        return keyline({"render", "graph.json", "--frames", "1-3", "--progress", mode});
    }
    static std::vector<nlohmann::json> events(const std::string& text) {
        std::vector<nlohmann::json> out;
        std::istringstream lines(text);
        for (std::string line; std::getline(lines, line);) out.push_back(nlohmann::json::parse(line));
        return out;
    }
};

TEST_F(Progress, LinesAreWhatAPipeGets) {
    graph(kNodes);
    for (const char* mode : {"auto", "lines"}) {
        const Outcome run = render(mode);
        EXPECT_EQ(run.out, "");
        EXPECT_THAT(run.err, HasSubstr("frame 2: done in "));
        EXPECT_THAT(run.err, HasSubstr("(2 of 3)"));
        EXPECT_THAT(run.err, Not(HasSubstr("\r")));
    }
}

TEST_F(Progress, NoneTellsWarningsAndTheEnd) {
    graph(kNodes);
    const Outcome run = render("none");
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(
        run.err,
        "graph.json:4:5: warning: node 'spare' (gaussian): nothing that is written uses it; it is not run\n"
        "keyline: done frames=1-3 retry=no reason=none\n");
}

TEST_F(Progress, TheBarIsDrawnAnewAndTakenAway) {
    graph(kNodes);
    const Outcome run = render("bar");
    EXPECT_THAT(run.err, HasSubstr("\r\x1b[K[==========     "));
    EXPECT_THAT(run.err, HasSubstr("3 of 3, frame 3 done"));
    EXPECT_THAT(run.err, HasSubstr("\r\x1b[K3 of 3 frames done"));
    EXPECT_THAT(run.err, HasSubstr(" s a frame"));
}

TEST_F(Progress, JsonIsAnObjectALine) {
    graph(kNodes);
    const auto all = events(render("json").err);
    // Frames overlap, so that one may start before another ends; each kind comes in order.
    std::vector<std::string> others;
    std::vector<int> started, ended;
    for (const auto& e : all) {
        const std::string event = e.at("event");
        if (event == "frame_started")
            started.push_back(e.at("frame"));
        else if (event == "frame_ended")
            ended.push_back(e.at("frame"));
        else
            others.push_back(event);
        EXPECT_TRUE(event != "frame_ended" || e.at("outcome") == "done");
    }
    EXPECT_THAT(others, testing::ElementsAre("warning", "start", "end"));
    EXPECT_THAT(started, testing::ElementsAre(1, 2, 3));
    EXPECT_THAT(ended, testing::ElementsAre(1, 2, 3));
    EXPECT_EQ(all[1].at("frames"), 3);
    EXPECT_EQ(all[2].at("outputs").at(0), "out.1.exr");
    EXPECT_EQ(all.back().at("done"), 3);
}

TEST_F(Progress, JsonHoldsErrorsToo) {
    graph(R"("r": { "type": "read", "file": "in.#.exr" },
             "out": { "type": "write", "in": "r", "file": "out.#.exr" })");
    const Outcome run = render("json");
    EXPECT_EQ(run.status, 3);
    const auto all = events(run.err);
    const auto error =
        std::ranges::find_if(all, [](const nlohmann::json& e) { return e.at("event") == "error"; });
    ASSERT_NE(error, all.end()) << run.err;
    EXPECT_THAT(error->at("text").get<std::string>(), HasSubstr("in.1.exr"));
    EXPECT_EQ(error->at("kind"), "input");
    EXPECT_EQ(error->at("place"),
              nlohmann::json::parse(R"({ "file": "graph.json", "line": 2, "column": 32 })"));
    EXPECT_EQ(error->at("node"), "node 'r' (read)");
    EXPECT_THAT(error->at("what").get<std::string>(), testing::StartsWith("in.1.exr: no such file"));
    EXPECT_EQ(all.back().at("untried"), "2, 3");
    EXPECT_EQ(all.back().at("frames"), "1-3");
    EXPECT_EQ(all.back().at("text"), "keyline: failed frames=1-3 retry=no reason=input");
}

TEST_F(Progress, WarningsNeverHoldTheWordOfErrors) {
    graph(R"("error: Error:": 1)");
    graph(R"("c": { "type": "constant", "color": [0, 0, 0], "size": [4, 4] },
             "r": { "type": "read", "file": "error:ERROR:.#.exr", "missing": "hold" },
             "out": { "type": "write", "in": "r", "file": "out.#.exr" })");
    fs::copy(plates() / "street.0001.exr", folder() / "error:ERROR:.1.exr");
    const Outcome run = render("lines");
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_THAT(run.err, HasSubstr("warning: "));
    for (const char* word : {"error:", "Error:", "ERROR:"}) EXPECT_THAT(run.err, Not(HasSubstr(word)));
}

TEST_F(Progress, AReaderThatGoesAwayStopsNoRender) {
    graph(kNodes);
    Process process({"render", "graph.json", "--frames", "1-3", "--progress", "lines"}, {.folder = folder()});
    process.close_standard_error();
    EXPECT_EQ(process.wait().status, 0);
    EXPECT_TRUE(exists("out.3.exr"));
}

}  // namespace

}  // namespace keyline::test
