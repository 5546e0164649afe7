// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/program/program.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <regex>

// render --report: what became of each frame, for programs and for people.

namespace keyline::test {

namespace {

using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::json;

class RunReports : public ProgramTest {
protected:
    // Five frames, of which the fourth has no plate, and a name that is markup.
    RunReports() {
        for (const int frame : {1, 2, 3, 5})
            fs::copy(plates() / "street.0001.exr", folder() / fmt::format("<in&>.{}.exr", frame));
        graph(R"("r":   { "type": "read", "file": "<in&>.#.exr" },
                 "out": { "type": "write", "in": "r:Combined", "file": "out.#.exr" })");
    }
    Outcome render(const std::string& report, std::vector<std::string> more = {}) const {
        more.insert(more.begin(),
                    {"render", "graph.json", "--frames", "1-5", "--keep-going", "--report", report});
        return keyline(more);
    }
    Json json() const { return Json::parse(read(folder() / "report.json")); }
};

TEST_F(RunReports, JsonTellsOfEachFrame) {
    EXPECT_EQ(render("report.json").status, 3);
    const Json report = json();
    EXPECT_EQ(report.at("status"), 3);
    EXPECT_EQ(report.at("retry"), false);
    EXPECT_EQ(report.at("reason"), "input");
    ASSERT_EQ(report.at("frames").size(), 5U);
    for (const Json& frame : report.at("frames")) {
        SCOPED_TRACE(frame.dump());
        if (frame.at("frame") == 4) {
            EXPECT_EQ(frame.at("outcome"), "failed");
            EXPECT_THAT(frame.at("errors").at(0).get<std::string>(), HasSubstr("no such file"));
            EXPECT_TRUE(frame.at("outputs").empty());
            continue;
        }
        EXPECT_EQ(frame.at("outcome"), "done");
        EXPECT_GT(frame.at("seconds"), 0);
        EXPECT_GT(frame.at("memory"), 1 << 20);
        EXPECT_GT(frame.at("planned"), 1 << 20);
        EXPECT_TRUE(frame.at("errors").empty());
        const Json& output = frame.at("outputs").at(0);
        EXPECT_EQ(output.at("node"), "out");
        EXPECT_EQ(output.at("state"), "current");
        EXPECT_THAT(output.at("file").get<std::string>(), HasSubstr("out."));
        EXPECT_EQ(output.at("hashes"), report.at("frames").at(0).at("outputs").at(0).at("hashes"))
            << "the plates are the same";
        EXPECT_GE(output.at("hashes").size(), 3U);
    }
}

TEST_F(RunReports, WarningsAreTheirFrames) {
    fs::remove(folder() / "<in&>.2.exr");
    EXPECT_EQ(render("report.json", {"--set", "r.missing=hold"}).status, 0);
    const Json report = json();
    for (const Json& frame : report.at("frames"))
        EXPECT_EQ(frame.at("warnings").size(), frame.at("frame") == 2 || frame.at("frame") == 4 ? 1U : 0U)
            << frame.dump();
}

TEST_F(RunReports, WhatIsSkippedAndWhatIsNotTriedIsSaid) {
    EXPECT_EQ(render("report.json").status, 3);
    EXPECT_EQ(
        keyline({"render", "graph.json", "--frames", "1-5", "--stale", "--report", "report.json"}).status, 3);
    std::string outcomes;
    const Json report = json();
    for (const Json& frame : report.at("frames")) outcomes += frame.at("outcome").get<std::string>() + " ";
    EXPECT_EQ(outcomes, "skipped skipped skipped failed untried ");
}

TEST_F(RunReports, ThePageStandsByItselfWithWhatFailedFirst) {
    EXPECT_EQ(render("report.html").status, 3);
    const std::string page = read(folder() / "report.html");
    EXPECT_THAT(page, HasSubstr("5 frames: 4 done, 0 skipped, 1 failed, 0 not tried"));
    EXPECT_THAT(page, HasSubstr("&lt;in&amp;&gt;.4.exr: no such file"));
    EXPECT_THAT(page, Not(HasSubstr("<in&>")));
    for (const char* elsewhere : {"http://", "https://", "src=\"/", "url(", "<script"})
        EXPECT_THAT(page, Not(HasSubstr(elsewhere)));
    const auto count = [&](const char* pattern) {
        const std::regex what(pattern);
        return std::distance(std::sregex_iterator(page.begin(), page.end(), what), {});
    };
    EXPECT_EQ(count("<svg "), 2);
    EXPECT_EQ(count("<img alt=\"frame [1235]\" src=\"data:image/jpeg;base64,/9j/"), 4);
    EXPECT_LT(page.find("<b>Frame 4</b>"), page.find("<svg"));
    EXPECT_LT(page.find("<figcaption>frame 4"), page.find("<figcaption>frame 1"));
}

TEST_F(RunReports, AnotherKindOfFileIsRefused) {
    const Outcome run = render("report.txt");
    EXPECT_EQ(run.status, 2);
    EXPECT_THAT(run.err, HasSubstr("--report report.txt: error: a report is a file .json or .html"));
    EXPECT_FALSE(exists("out.1.exr"));
}

TEST_F(RunReports, AReportThatCannotBeWrittenIsAnError) {
    const Outcome run = render("no/report.json");
    EXPECT_EQ(run.status, 4);
    EXPECT_THAT(run.err, HasSubstr("no/report.json: can't be written"));
}

}  // namespace

}  // namespace keyline::test
