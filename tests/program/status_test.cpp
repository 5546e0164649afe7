// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/program/program.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

// Exit statuses, and what is left in the folder after each.

namespace keyline::test {

namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char* kConstant = R"("c": { "type": "constant", "color": [0.5, 0.25, 0], "size": [32, 16] })";

std::string to_write(const std::string& in, const std::string& file) {
    return fmt::format(R"(, "out": {{ "type": "write", "in": "{}", "file": "{}" }})", in, file);
}

class Status : public ProgramTest {};

TEST_F(Status, ZeroWhenAllIsDone) {
    graph(kConstant + to_write("c", "out.exr"));
    const Outcome run = keyline({"render", "graph.json"});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.out, "");
    EXPECT_THAT(files(), testing::ElementsAre("graph.json", "out.exr"));
}

TEST_F(Status, TwoForAWrongCommandLine) {
    graph(kConstant + to_write("c", "out.exr"));
    const std::vector<std::vector<std::string>> wrong{
        {},
        {"rendr", "graph.json"},
        {"render"},
        {"render", "graph.json", "more.json"},
        {"render", "graph.json", "--frmes", "1"},
        {"render", "graph.json", "--frames"},
        {"render", "graph.json", "--frames", "4-"},
        {"render", "graph.json", "--frames", "1-4x0"},
        {"render", "graph.json", "--frames", "one"},
        {"render", "graph.json", "--threads", "0"},
        {"render", "graph.json", "--threads", "many"},
        {"render", "graph.json", "--tile", "-1"},
        {"render", "graph.json", "--memory", "lots"},
        {"render", "graph.json", "--memory", "1K"},
        {"render", "graph.json", "--progress", "loud"},
        {"render", "graph.json", "--set", "c.size"},
        {"render", "graph.json", "--var", "a=1"},
        {"render", "graph.json", "--only", "c"},
        {"render", "graph.json", "--output", "nobody=x.exr"},
        {"render", "missing.json"},
        {"render", "."},
        {"check", "graph.json", "--threads", "2"},
        {"nodes", "gausian"},
        {"nodes", "gaussian", "--markdown"},
    };
    for (const auto& arguments : wrong) {
        const Outcome run = keyline(arguments);
        SCOPED_TRACE(testing::PrintToString(arguments));
        EXPECT_EQ(run.status, 2) << run.err;
        EXPECT_EQ(run.out, "");
        EXPECT_THAT(run.err, HasSubstr("error: "));
        EXPECT_THAT(run.err, Not(HasSubstr("internal")));
    }
    EXPECT_THAT(files(), testing::ElementsAre("graph.json"));
}

TEST_F(Status, TwoForAWrongGraph) {
    graph(kConstant + to_write("d", "out.exr"));
    const Outcome run = keyline({"render", "graph.json"});
    EXPECT_EQ(run.status, 2);
    EXPECT_THAT(run.err, HasSubstr("graph.json:2:"));
    EXPECT_FALSE(exists("out.exr"));
}

TEST_F(Status, TwoForAFrameNumberWithoutFrames) {
    graph(kConstant + to_write("c", "out.####.exr"));
    const Outcome run = keyline({"render", "graph.json"});
    EXPECT_EQ(run.status, 2);
    EXPECT_THAT(run.err, HasSubstr("--frames"));
}

TEST_F(Status, ThreeForAMissingInput) {
    graph(R"("r": { "type": "read", "file": "nowhere.exr" })" + to_write("r", "out.exr"));
    for (const char* command : {"render", "check", "plan"}) {
        const Outcome run = keyline({command, "graph.json"});
        EXPECT_EQ(run.status, 3) << command << run.err;
        EXPECT_THAT(run.err, HasSubstr("nowhere.exr"));
    }
    EXPECT_FALSE(exists("out.exr"));
}

TEST_F(Status, ThreeForADamagedInput) {
    // In the middle of its pixels: the header is sound.
    std::string plate = read(plates() / "street.0001.exr");
    for (std::size_t i = plate.size() / 2; i < plate.size() / 2 + 64; ++i) plate[i] = '\x5a';
    write("plate.exr", plate);
    graph(R"("r": { "type": "read", "file": "plate.exr" })" + to_write("r", "out.exr"));
    const Outcome run = keyline({"render", "graph.json"});
    EXPECT_EQ(run.status, 3) << run.err;
    EXPECT_THAT(run.err, HasSubstr("node 'r' (read)"));
    EXPECT_THAT(run.err, HasSubstr("plate.exr"));
    EXPECT_THAT(files(), testing::ElementsAre("graph.json", "plate.exr"));
}

TEST_F(Status, TwoOutranksThree) {
    graph(R"("r": { "type": "read", "file": "nowhere.exr" }, )" + std::string(kConstant) +
          to_write("r", "out.exr") + R"(, "two": { "type": "write", "in": "c:Z", "file": "two.exr" })");
    const Outcome run = keyline({"check", "graph.json"});
    EXPECT_EQ(run.status, 2);
    EXPECT_THAT(run.err, HasSubstr("nowhere.exr"));
    EXPECT_THAT(run.err, HasSubstr("node 'two' (write)"));
}

TEST_F(Status, FourForAnOutputThatCannotBeWritten) {
    write("file", "a file, not a folder");
    fs::create_directory(folder() / "folder.exr");
    for (const char* name : {"file/out.exr", "folder.exr", "/proc/out.exr"}) {
        graph(kConstant + to_write("c", name));
        const Outcome run = keyline({"render", "graph.json"});
        EXPECT_EQ(run.status, 4) << name << ": " << run.err;
        EXPECT_THAT(run.err, HasSubstr("node 'out' (write)"));
    }
    EXPECT_THAT(files(), testing::ElementsAre("file", "graph.json"));
}

TEST_F(Status, TheFirstFailedFrameCounts) {
    for (const int frame : {1, 4})
        fs::copy(plates() / "street.0001.exr", folder() / fmt::format("in.{}.exr", frame));
    write("in.3.exr", "no image");
    fs::create_directories(folder() / "out.4.exr");
    graph(R"("r": { "type": "read", "file": "in.#.exr" })" + to_write("r", "out.#.exr"));
    const Outcome input_first = keyline({"render", "graph.json", "--frames", "1-4", "--keep-going"});
    EXPECT_EQ(input_first.status, 3);
    EXPECT_TRUE(exists("out.1.exr"));
    const Outcome output_first = keyline({"render", "graph.json", "--frames", "4,3", "--keep-going"});
    EXPECT_EQ(output_first.status, 4);
}

TEST_F(Status, FourForALostResult) {
    const Outcome run = keyline({"nodes"}, {.out = "/dev/full"});
    EXPECT_EQ(run.status, 4);
    EXPECT_THAT(run.err, HasSubstr("standard output"));
}

}  // namespace

}  // namespace keyline::test
