// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/program/program.h"

#include <gmock/gmock.h>

// Files of variables, and what is told of variables.

namespace keyline::test {

namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

class VariablesOfFiles : public ProgramTest {
protected:
    VariablesOfFiles() {
        graph(R"("c": { "type": "constant", "color": [0, 0, 0], "size": ["${width}", 8] },
                 "out": { "type": "write", "in": "c", "file": "${name}.exr" })",
              R"("include": ["show.json", "shots/${shot}.json"],
                 "variables": { "width": 1, "name": "graph", "shot": "a" },)");
        write("show.json", R"({ "width": 2, "name": "show" })");
        write("shots/a.json", R"({ "name": "a", "unused": 1 })");
        write("shots/b.json", R"({ "width": 4, "name": "b${unknown}" })");
        write("run.json", R"({ "name": "run" })");
    }
    Outcome run(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin() + 1, "graph.json");
        return keyline(arguments);
    }
};

TEST_F(VariablesOfFiles, LaterStandsOverEarlier) {
    const Outcome outcome = run({"plan"});
    EXPECT_THAT(outcome.out, HasSubstr("variables:\n"
                                       "  name = \"a\", from shots/a.json:1:11\n"
                                       "  shot = \"a\", from graph.json:"));
    EXPECT_THAT(outcome.out, HasSubstr("  unused = 1, from shots/a.json:1:26\n"
                                       "  width = 2, from show.json:1:12\n"));
    EXPECT_EQ(outcome.err, "") << "files may hold more than a graph uses";
    EXPECT_THAT(run({"plan", "--vars", "run.json"}).out, HasSubstr("  name = \"run\", from run.json:1:11\n"));
    EXPECT_THAT(run({"plan", "--vars", "run.json", "--var", "name=x"}).out,
                HasSubstr("  name = \"x\", from --var name=x\n"));
}

TEST_F(VariablesOfFiles, AreRenderedWith) {
    EXPECT_EQ(run({"render", "--progress", "none"}).status, 0);
    EXPECT_TRUE(exists("a.exr"));
    EXPECT_THAT(keyline({"info", "a.exr"}).out, HasSubstr("2 × 8"));
}

TEST_F(VariablesOfFiles, AFileMayBeNamedByAVariable) {
    EXPECT_EQ(run({"check", "--var", "shot=b"}).err,
              "shots/b.json:1:23: error: unknown variable 'unknown'; the graph declares 'name', 'shot' and "
              "'width'\n");
}

TEST_F(VariablesOfFiles, AreFoundFromTheGraphsFolder) {
    write("elsewhere/empty", "");
    RunOptions there;
    there.folder = folder() / "elsewhere";
    EXPECT_EQ(keyline({"check", "../graph.json"}, there).status, 0);
    EXPECT_THAT(keyline({"check", "../graph.json", "--vars", "../run.json"}, there).err, "");
}

class VariablesTold : public ProgramTest {};

TEST_F(VariablesTold, WhatNobodyUses) {
    graph(R"("c": { "type": "constant", "color": [0, 0, 0], "size": [8, 8] },
             "out": { "type": "write", "in": "c", "file": "a.exr" })",
          R"("variables": { "sigma": 1 },)");
    const Outcome outcome = keyline({"check", "graph.json"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(outcome.err, HasSubstr("warning: nothing uses the variable 'sigma'\n"));
}

TEST_F(VariablesTold, NotTheBranchesOfASwitch) {
    graph(R"("c": { "type": "constant", "color": [0, 0, 0], "size": [8, 8] },
             "d": { "type": "constant", "color": [1, 0, 0], "size": [8, 8] },
             "blur": { "type": "gaussian", "in": "d", "sigma": 1 },
             "forgotten": { "type": "gaussian", "in": "d", "sigma": 1 },
             "out": { "type": "write", "in": "${look}", "file": "a.exr" })",
          R"("variables": { "look": { "default": "c", "choices": ["c", "blur:R"] } },)");
    const Outcome outcome = keyline({"check", "graph.json"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(outcome.err, HasSubstr("node 'forgotten' (gaussian): nothing that is written uses it"));
    EXPECT_THAT(outcome.err, Not(HasSubstr("'blur'")));
    EXPECT_EQ(keyline({"check", "graph.json", "--var", "look=blur:R"}).status, 0);
}

}  // namespace

}  // namespace keyline::test
