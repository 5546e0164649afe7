// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/program/program.h"

#include <csignal>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

// What a render farm goes by: the status, and the last line of the log.

namespace keyline::test {

namespace {

constexpr const char* kConstant = R"(
    "c":   { "type": "constant", "color": [0.5, 0.25, 0], "size": [32, 16] },
    "out": { "type": "write", "in": "c", "file": "out.#.exr" })";
constexpr const char* kPlates = R"(
    "r":   { "type": "read", "file": "in.#.exr" },
    "out": { "type": "write", "in": "r", "file": "out.#.exr" })";

class Endings : public ProgramTest {
protected:
    static std::string last_line(const std::string& text) {
        const std::size_t end = text.find_last_not_of('\n');
        const std::size_t before = end == std::string::npos ? end : text.rfind('\n', end);
        return text.substr(before == std::string::npos ? 0 : before + 1, end - before);
    }
    // The last line of a render with these options, and its status before it.
    std::string ending(std::vector<std::string> options, const RunOptions& run_options = {}) const {
        options.insert(options.begin(), {"render", "graph.json"});
        const Outcome run = keyline(options, run_options);
        return fmt::format("{} {}", run.status, last_line(run.err));
    }
    std::string plate() const { return read(plates() / "street.0001.exr"); }
};

TEST_F(Endings, AGoodRenderNamesItsFramesInEveryMode) {
    graph(kConstant);
    for (const char* mode : {"auto", "bar", "lines", "none"})
        EXPECT_EQ(ending({"--frames", "1-3,7", "--progress", mode}),
                  "0 keyline: done frames=1-3,7 retry=no reason=none");
    const auto event = nlohmann::json::parse(ending({"--frames", "1-3,7", "--progress", "json"}).substr(2));
    EXPECT_EQ(event.at("text"), "keyline: done frames=1-3,7 retry=no reason=none");
    EXPECT_EQ(event.at("status"), 0);
}

TEST_F(Endings, WhatIsWrongWithTheGraphIsNotTriedAgain) {
    graph(kConstant);
    EXPECT_EQ(ending({"--frames", "1-3", "--set", "c.sise=3"}),
              "2 keyline: failed frames=1-3 retry=no reason=graph");
    EXPECT_EQ(ending({"--frames", "3-1,"}), "2 keyline: failed frames=- retry=no reason=graph");
    EXPECT_EQ(ending({}), "2 keyline: failed frames=1 retry=no reason=graph");
}

TEST_F(Endings, OfSomeFramesTheOthersAreNamed) {
    graph(kPlates);
    for (const int frame : {1, 2, 5}) write(fmt::format("in.{}.exr", frame), plate());
    EXPECT_EQ(ending({"--frames", "1-5", "--keep-going"}),
              "3 keyline: failed frames=3,4 retry=no reason=input");
    EXPECT_EQ(ending({"--frames", "1-5"}), "3 keyline: failed frames=3-5 retry=no reason=input");
}

TEST_F(Endings, AnInputThatGrowsIsTriedAgain) {
    graph(kPlates);
    const std::string whole = plate();
    for (const std::size_t bytes : {whole.size() / 2, whole.size() - 1, std::size_t{0}}) {
        write("in.1.exr", whole.substr(0, bytes));
        EXPECT_EQ(ending({"--frames", "1"}), "75 keyline: failed frames=1 retry=yes reason=unfinished")
            << bytes;
    }
    write("in.1.exr", whole);
    EXPECT_EQ(ending({"--frames", "1"}), "0 keyline: done frames=1 retry=no reason=none");
}

// Frame 1 may do better, frame 2 will not: that decides, whichever comes first.
TEST_F(Endings, WhatStaysOutranksWhatMayPass) {
    graph(kPlates);
    write("in.1.exr", plate().substr(0, 200000));
    for (const char* frames : {"1-2", "2-1"})
        EXPECT_EQ(ending({"--frames", frames, "--keep-going"}),
                  fmt::format("3 keyline: failed frames={} retry=no reason=input",
                              frames[0] == '1' ? "1,2" : "2,1"));
}

TEST_F(Endings, TooLittleMemoryAllottedIsTriedAgainAndTypedIsNot) {
    graph(kConstant);
    EXPECT_EQ(ending({"--frames", "1"}, {.environment = {"SLURM_MEM_PER_NODE=1"}}),
              "75 keyline: failed frames=1 retry=yes reason=memory");
    EXPECT_EQ(ending({"--frames", "1", "--memory", "1M"}),
              "2 keyline: failed frames=1 retry=no reason=graph");
}

TEST_F(Endings, AStoppedRenderIsTriedAgain) {
    graph(kConstant);
    Process process({"render", "graph.json", "--frames", "1-100000", "--progress", "lines"},
                    {.folder = folder()});
    ASSERT_TRUE(process.read_until("frame 3: done"));
    process.signal(SIGTERM);
    const Outcome run = process.wait();
    EXPECT_EQ(run.status, 143);
    EXPECT_THAT(last_line(run.err),
                testing::MatchesRegex("keyline: failed frames=[0-9]+-100000 retry=yes reason=stopped"));
}

}  // namespace

}  // namespace keyline::test
