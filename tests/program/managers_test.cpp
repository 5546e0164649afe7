// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/program/program.h"

#include <algorithm>
#include <fmt/format.h>
#include <functional>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <regex>
#include <sstream>

// What the managers of render farms read: their rules, as readers of a few lines, on real output.

namespace keyline::test {

namespace {

using testing::HasSubstr;

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> out;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) out.push_back(line);
    return out;
}

// What a manager makes of a log.
struct Heard {
    std::vector<double> progress;  // percents of the task
    bool failure = false;          // said, beside the status
};

// Session logs of Open Job Description: messages stand at the start of a line.
Heard openjd(const std::string& log) {
    Heard out;
    std::smatch m;
    static const std::regex message("^openjd_(progress|status|fail): (.+)$");
    for (const std::string& line : lines_of(log)) {
        if (!std::regex_match(line, m, message)) continue;
        if (m[1] == "progress") out.progress.push_back(std::stod(m[2]));
        if (m[1] == "fail") out.failure = true;
    }
    return out;
}

// Frames are counted, the first does not count; percents are of the frame and must be whole numbers.
Heard afanasy(const std::string& log, int frames) {
    Heard out;
    int counted = 0, percent = 0;
    for (const std::string& line : lines_of(log)) {
        for (const char* word : {"[ parser error ]", "[ parser fatal error ]", "[ parser bad result ]"}) {
            std::string small = line;
            std::ranges::transform(small, small.begin(), [](unsigned char c) { return std::tolower(c); });
            out.failure = out.failure || small.find(word) != std::string::npos;
        }
        if (line.find("FRAME: ") != std::string::npos) ++counted, percent = 0;
        const std::size_t at = line.find("PROGRESS: ");
        if (at != std::string::npos) {
            const std::string number = line.substr(at + 10, line.find('%', at) - at - 10);
            EXPECT_TRUE(std::ranges::all_of(number, [](char c) { return c >= '0' && c <= '9'; })) << line;
            percent = std::stoi(number);
        }
        out.progress.push_back((100.0 * std::max(0, counted - 1) + percent) / frames);
    }
    return out;
}

Heard by_regex(const std::string& log, const char* pattern) {
    Heard out;
    std::smatch m;
    const std::regex percent(pattern);
    for (const std::string& line : lines_of(log))
        if (std::regex_search(line, m, percent)) out.progress.push_back(std::stod(m[1]));
    return out;
}

struct Manager {
    const char* name;
    std::function<Heard(const std::string&)> read;
    bool tells_failure = false;
};

const std::vector<Manager>& managers() {
    static const std::vector<Manager> all{
        {"openjd", openjd, true},
        {"afanasy", [](const std::string& log) { return afanasy(log, 5); }},
        {"tractor", [](const std::string& log) { return by_regex(log, "TR_PROGRESS +([0-9]+)%"); }},
        {"deadline", [](const std::string& log) { return by_regex(log, "^Progress: ([0-9]+)%"); }}};
    return all;
}

class Managers : public ProgramTest {
protected:
    // Five frames, whose plates have a name that managers would take for their own words; of the last one
    // there may be none.
    Managers() {
        graph(R"("r":   { "type": "read", "file": "openjd_fail: [ PARSER ERROR ] PROGRESS: 7%%.#.exr" },
                 "out": { "type": "write", "in": "r:Combined", "file": "out.#.exr" })");
        for (int frame = 1; frame <= 4; ++frame) plate(frame);
    }
    void plate(int frame) const {
        fs::copy(plates() / "street.0001.exr",
                 folder() / fmt::format("openjd_fail: [ PARSER ERROR ] PROGRESS: 7%.{}.exr", frame));
    }
    Outcome render(const std::string& progress, const RunOptions& options = {}) const {
        return keyline({"render", "graph.json", "--frames", "1-5", "--keep-going", "--progress", progress},
                       options);
    }
    static void expect_rising(const Heard& heard) {
        EXPECT_FALSE(heard.progress.empty());
        EXPECT_TRUE(std::ranges::is_sorted(heard.progress)) << testing::PrintToString(heard.progress);
    }
};

TEST_F(Managers, ProgressRisesToAHundredWhereAllIsDone) {
    plate(5);
    for (const Manager& m : managers()) {
        SCOPED_TRACE(m.name);
        const Outcome run = render(m.name);
        EXPECT_EQ(run.status, 0) << run.err;
        const Heard heard = m.read(run.err);
        expect_rising(heard);
        EXPECT_EQ(heard.progress.back(), 100) << run.err;
        EXPECT_FALSE(heard.failure) << run.err;
    }
}

TEST_F(Managers, AFailureIsSeenAndNeverAHundredPercent) {
    for (const Manager& m : managers()) {
        SCOPED_TRACE(m.name);
        const Outcome run = render(m.name);
        EXPECT_EQ(run.status, 3) << run.err;
        const Heard heard = m.read(run.err);
        expect_rising(heard);
        EXPECT_LT(heard.progress.back(), 100) << run.err;
        EXPECT_GE(heard.progress.back(), 60) << run.err;
        EXPECT_EQ(heard.failure, m.tells_failure) << run.err;
        EXPECT_THAT(run.err, HasSubstr("error: "));
        EXPECT_THAT(run.err, HasSubstr("keyline: failed frames=5 retry=no reason=input\n"));
    }
}

TEST_F(Managers, AutoKnowsThemByTheirEnvironment) {
    plate(5);
    EXPECT_THAT(render("auto", {.environment = {"DEADLINE_SESSIONACTION_ID=sessionaction-1"}}).err,
                HasSubstr("openjd_progress: 100\n"));
    EXPECT_THAT(render("auto", {.environment = {"AF_TASK_ID=0"}}).err, HasSubstr("FRAME: 5\n"));
    EXPECT_THAT(render("auto", {.environment = {"TR_ENV_TID=1"}}).err, HasSubstr("TR_PROGRESS 100%\n"));
    EXPECT_THAT(keyline({"render", "graph.json", "--frames", "1-5"},
                        {.environment = {"CUE_FRAME=0001-render"}, .through = KEYLINE_TERMINAL})
                    .err,
                HasSubstr("frame 5: done"))
        << "no bar, whatever the log is";
    EXPECT_THAT(render("auto").err, HasSubstr("frame 5: done"));
    EXPECT_THAT(render("flamenco").err, HasSubstr("frame 5: done"));
}

// OpenCue has expressions for the last fifty lines of a log, which say whether a frame is tried again;
// Flamenco goes by the status alone.
TEST_F(Managers, TheLastLinesSayWhetherToTryAgain) {
    const auto tries_again = [](const std::string& log) {
        std::vector<std::string> last = lines_of(log);
        if (last.size() > 50) last.erase(last.begin(), last.end() - 50);
        static const std::regex retry("^keyline: failed .*retry=yes"), never("^keyline: failed .*retry=no");
        const auto says = [&](const std::regex& what) {
            return std::ranges::any_of(last, [&](const auto& l) { return std::regex_search(l, what); });
        };
        EXPECT_NE(says(retry), says(never)) << log;
        return says(retry);
    };
    for (const char* progress : {"lines", "flamenco"}) {
        const Outcome missing = render(progress);
        EXPECT_EQ(missing.status, 3);
        EXPECT_FALSE(tries_again(missing.err));
        write("openjd_fail: [ PARSER ERROR ] PROGRESS: 7%.5.exr", "");
        const Outcome unfinished = render(progress);
        EXPECT_EQ(unfinished.status, 75);
        EXPECT_TRUE(tries_again(unfinished.err));
        fs::remove(folder() / "openjd_fail: [ PARSER ERROR ] PROGRESS: 7%.5.exr");
    }
}

// A frame that takes long is not silent: some managers kill what is.
TEST_F(Managers, LongFramesAreNotSilent) {
    graph(R"("c":    { "type": "constant", "color": [0.5, 0.25, 0], "size": [2000, 2000] },
             "blur": { "type": "gaussian", "in": "c", "sigma": 20 },
             "out":  { "type": "write", "in": "blur", "file": "out.#.exr" })");
    struct Case {
        const char *mode, *says;
    };
    for (const Case& c :
         {Case{"lines", " % after "}, Case{"json", R"("event": "progress", "frame": 1)"},
          Case{"openjd", "openjd_progress: 0\nopenjd_status: frame 1\nopenjd_progress: "},
          Case{"afanasy", "PROGRESS: "}, Case{"tractor", "TR_PROGRESS "}, Case{"deadline", "Progress: "}}) {
        SCOPED_TRACE(c.mode);
        Process process({"render", "graph.json", "--frames", "1", "--progress", c.mode, "--threads", "1",
                         "--heartbeat", "0.01"},
                        {.folder = folder()});
        EXPECT_TRUE(process.read_until(c.says));
    }
    EXPECT_EQ(keyline({"render", "graph.json", "--frames", "1", "--heartbeat", "often"}).status, 2);
}

}  // namespace

}  // namespace keyline::test
