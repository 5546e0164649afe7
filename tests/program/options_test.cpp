// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/program/program.h"

#include <algorithm>
#include <fmt/format.h>
#include <gmock/gmock.h>

// What the options of render change.

namespace keyline::test {

namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// Two writes from one blur, with a variable for its size.
constexpr const char* kNodes = R"(
    "c":    { "type": "constant", "color": [0.5, 0.25, 0], "size": [32, 16] },
    "dot":  { "type": "constant", "color": [1, 1, 1], "size": [8, 8] },
    "blur": { "type": "gaussian", "in": "c", "sigma": "${sigma}" },
    "comp": { "type": "over", "fg": "dot", "bg": "blur" },
    "a":    { "type": "write", "in": "comp", "file": "${name}.exr" },
    "b":    { "type": "write", "in": "c", "file": "b.exr" })";
constexpr const char* kVariables = R"("variables": { "sigma": 2, "name": "a" },)";

class Options : public ProgramTest {
protected:
    Options() { graph(kNodes, kVariables); }

    Outcome render(std::vector<std::string> options) const {
        options.insert(options.begin(), {"render", "graph.json", "--progress", "none"});
        return keyline(options);
    }
    // What `info` tells of an image, its name left out.
    std::string info(const std::string& name) const {
        const std::string out = keyline({"info", "--all", name}).out;
        return out.substr(std::min(out.size(), out.find('\n')));
    }
};

TEST_F(Options, AnEmptyValueDoesNotSwallowTheNextOption) {
    const Outcome run = render({"--root=", "--only=a"});
    EXPECT_EQ(run.status, 2);
    EXPECT_THAT(run.err, HasSubstr("the value of --root is empty"));
}

TEST_F(Options, AllWritesWithoutOnly) {
    EXPECT_EQ(render({}).status, 0);
    EXPECT_THAT(files(), ElementsAre("a.exr", "b.exr", "graph.json"));
}

TEST_F(Options, OnlyRunsThatWrite) {
    EXPECT_EQ(render({"--only", "b"}).status, 0);
    EXPECT_THAT(files(), ElementsAre("b.exr", "graph.json"));
}

TEST_F(Options, OnlyMayBeRepeated) {
    EXPECT_EQ(render({"--only", "b", "--only=a"}).status, 0);
    EXPECT_THAT(files(), ElementsAre("a.exr", "b.exr", "graph.json"));
}

TEST_F(Options, SetChangesParametersAndInputs) {
    EXPECT_EQ(render({"--set", "c.size=[64, 8]", "--set", "a.in=c:R", "--set=a.file=set.exr"}).status, 0);
    EXPECT_THAT(files(), ElementsAre("b.exr", "graph.json", "set.exr"));
    EXPECT_THAT(info("set.exr"), HasSubstr("64 × 8 at (0, 0)"));
    EXPECT_THAT(info("set.exr"), HasSubstr("    R half\n"));
}

TEST_F(Options, SetTakesWhatIsNotJsonAsText) {
    EXPECT_EQ(render({"--set", "a.depth=float", "--set", "a.compression=piz"}).status, 0);
    EXPECT_THAT(info("a.exr"), HasSubstr("R G B A float"));
    EXPECT_THAT(info("a.exr"), HasSubstr("piz"));
}

TEST_F(Options, SetGivesAValueWithEqualsSigns) {
    EXPECT_EQ(render({"--set", "a.file=a=b.exr", "--only", "a"}).status, 0);
    EXPECT_THAT(files(), ElementsAre("a=b.exr", "graph.json"));
}

TEST_F(Options, TheLastSetOfANameCounts) {
    EXPECT_EQ(render({"--set", "b.file=x.exr", "--set", "b.file=y.exr", "--only", "b"}).status, 0);
    EXPECT_THAT(files(), ElementsAre("graph.json", "y.exr"));
}

TEST_F(Options, VarOverridesAVariable) {
    EXPECT_EQ(render({"--var", "name=007", "--only", "a"}).status, 0);
    EXPECT_THAT(files(), ElementsAre("007.exr", "graph.json")) << "declared as a string, it stays one";
}

TEST_F(Options, AnOptionDoesNotSwallowTheGraph) {
    const Outcome run = keyline({"render", "--set", "c.size=[4, 4]", "--only", "b", "graph.json"});
    EXPECT_EQ(run.status, 0) << run.err;
}

TEST_F(Options, OutputWritesAnyNodeInsteadOfTheWrites) {
    EXPECT_EQ(render({"--output", "blur=look.exr", "--output", "comp:A=alpha.exr"}).status, 0);
    EXPECT_THAT(files(), ElementsAre("alpha.exr", "graph.json", "look.exr"));
    EXPECT_THAT(info("alpha.exr"), HasSubstr("    A half\n"));
}

TEST_F(Options, TypedPathsAreRelativeToTheWorkingDirectory) {
    const fs::path elsewhere = folder() / "elsewhere";
    fs::create_directory(elsewhere);
    const Outcome run =
        keyline({"render", "../graph.json", "--output", "c=typed.exr"}, {.folder = elsewhere});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_THAT(files(), ElementsAre("elsewhere/typed.exr", "graph.json"));
    EXPECT_EQ(keyline({"render", "../graph.json", "--only", "b"}, {.folder = elsewhere}).status, 0);
    EXPECT_THAT(files(), ElementsAre("b.exr", "elsewhere/typed.exr", "graph.json"));
}

TEST_F(Options, RootReplacesTheGraphsFolderForTypedPathsToo) {
    fs::create_directory(folder() / "root");
    EXPECT_EQ(render({"--root", "root", "--only", "b"}).status, 0);
    EXPECT_EQ(render({"--root", "root", "--output", "c=typed.exr"}).status, 0);
    EXPECT_THAT(files(), ElementsAre("graph.json", "root/b.exr", "root/typed.exr"));
}

TEST_F(Options, ThreadsTileAndMemoryChangeNoByte) {
    ASSERT_EQ(render({"--only", "a"}).status, 0);
    const std::string expected = read(folder() / "a.exr");
    const std::vector<std::vector<std::string>> ways{{"--threads", "1"},  {"--threads", "7"},
                                                     {"--tile", "1"},     {"--tile", "5", "--threads", "3"},
                                                     {"--memory", "64M"}, {"--memory=2G"}};
    for (std::vector<std::string> way : ways) {
        SCOPED_TRACE(testing::PrintToString(way));
        way.insert(way.end(), {"--only", "a"});
        ASSERT_EQ(render(way).status, 0);
        EXPECT_EQ(read(folder() / "a.exr"), expected);
    }
}

TEST_F(Options, TooLittleMemorySaysTheLeast) {
    const Outcome run = render({"--memory", "1M"});
    EXPECT_EQ(run.status, 2);
    EXPECT_THAT(run.err, HasSubstr("give --memory "));
    EXPECT_THAT(files(), ElementsAre("graph.json"));
    // What it says is enough.
    const auto at = run.err.find("give --memory ") + 14;
    EXPECT_EQ(render({"--memory", run.err.substr(at, run.err.find_first_of("\n ", at) - at)}).status, 0);
}

TEST_F(Options, OcioComesFromOptionGraphOrEnvironment) {
    const std::string to = R"("to": { "type": "colorspace", "in": "c", "to": "ACEScg" })";
    graph(R"("c": { "type": "constant", "color": [0, 0, 0], "size": [4, 4] }, )" + to +
          R"(, "out": { "type": "write", "in": "to", "file": "out.exr" })");
    EXPECT_EQ(keyline({"check", "graph.json"}).status, 0);
    const Outcome option = keyline({"check", "graph.json", "--ocio", "option.ocio"});
    EXPECT_EQ(option.status, 3);
    EXPECT_THAT(option.err, HasSubstr("option.ocio"));
    const Outcome environment = keyline({"check", "graph.json"}, {.environment = {"OCIO=environment.ocio"}});
    EXPECT_THAT(environment.err, HasSubstr("environment.ocio"));
    graph(R"("c": { "type": "constant", "color": [0, 0, 0], "size": [4, 4] }, )" + to +
              R"(, "out": { "type": "write", "in": "to", "file": "out.exr" })",
          R"("ocio": "graphs.ocio",)");
    const Outcome graphs = keyline({"check", "graph.json"}, {.environment = {"OCIO=environment.ocio"}});
    EXPECT_THAT(graphs.err, HasSubstr("graphs.ocio"));
}

// An internal error names such a command.
TEST_F(Options, ATileOfANodeIsComputedAlone) {
    const auto tile = [&](const std::string& which) {
        return keyline({"render", "graph.json", "--only-tile", which, "--frames=3"});
    };
    const Outcome alone = tile("c@4,8,16,8");
    EXPECT_EQ(alone.status, 0) << alone.err;
    EXPECT_THAT(alone.out, testing::StartsWith("c, frame 3: 16 × 8 at (4, 8)\n  R: "));
    EXPECT_THAT(alone.out, HasSubstr(" from 0.25 to 0.25, 0 not finite\n"));
    EXPECT_EQ(tile("c@4,8,16,8").out, alone.out);
    EXPECT_NE(tile("blur@4,8,16,8").out, alone.out);
    EXPECT_THAT(files(), ElementsAre("graph.json")) << "nothing is written";
    EXPECT_THAT(tile("blurr@0,0,4,4").err, HasSubstr("there is no node 'blurr' that makes an image"));
    for (const char* wrong : {"c", "c@1,2,3", "c@1,2,3,0", "@1,2,3,4", "c@1,2,3,x", "c@1,2,3,4,5"}) {
        const Outcome refused = tile(wrong);
        EXPECT_EQ(refused.status, 2) << wrong;
        EXPECT_THAT(refused.err, HasSubstr(std::string("--only-tile ") + wrong + ": error: ")) << wrong;
    }
}

// A config that OpenColorIO has something to say of: in Keyline's form, once, and as an event where those are
// asked for.
TEST_F(Options, WhatOpenColorIOSaysIsAWarning) {
    write("show.ocio",
          "ocio_profile_version: 2\n"
          "roles:\n  default: raw\n  scene_linear: raw\n"
          "displays:\n  screen:\n    - !<View> {name: Raw, colorspace: raw}\n"
          "colorspaces:\n  - !<ColorSpace>\n    name: raw\n    isdata: true\n    mood: gloomy\n"
          "  - !<ColorSpace>\n    name: other\n");
    graph(R"("c": { "type": "constant", "color": [0, 0, 0], "size": [4, 4] },
             "to": { "type": "colorspace", "in": "c", "to": "other" },
             "out": { "type": "write", "in": "to", "file": "out.#.exr" })",
          R"("ocio": "show.ocio",)");
    const Outcome lines = keyline({"render", "graph.json", "--frames", "1-3", "--progress", "none"});
    EXPECT_EQ(lines.status, 0) << lines.err;
    EXPECT_TRUE(lines.err.starts_with("warning: OpenColorIO: ")) << lines.err;
    EXPECT_THAT(lines.err, HasSubstr("mood"));
    EXPECT_THAT(lines.err, testing::Not(HasSubstr("[OpenColorIO")));
    EXPECT_EQ(std::ranges::count(lines.err, '\n'), 2) << lines.err;  // and how the run ended
    const Outcome json = keyline({"render", "graph.json", "--frames", "1-3", "--progress", "json"});
    EXPECT_THAT(json.err, HasSubstr(R"({"event": "warning", "text": "warning: OpenColorIO: )"));
}

}  // namespace

}  // namespace keyline::test
