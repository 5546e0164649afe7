// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/program/program.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

// keyline test: tests that users write.

namespace keyline::test {

namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class GraphTests : public ProgramTest {
protected:
    // A file of one test.
    void one(std::string_view body) const {
        write("tests.json", fmt::format(R"({{ "keyline": 1, "tests": {{ "t": {{ {} }} }} }})", body));
    }
    Outcome test(std::vector<std::string> more = {}) const {
        more.insert(more.begin(), {"test", "tests.json"});
        return keyline(more);
    }
    std::string fault_of(std::string_view body) const {
        one(body);
        const Outcome run = test();
        EXPECT_EQ(run.status, 1) << run.out << run.err;
        return run.out;
    }
    void expect_pass(std::string_view body) const {
        one(body);
        const Outcome run = test();
        EXPECT_EQ(run.status, 0) << run.out << run.err;
        EXPECT_EQ(run.out, "1 test, none failed\n");
    }
};

TEST_F(GraphTests, NodesByThemselvesOnGrids) {
    expect_pass(R"("images": { "dot": ["...", ".1.", "..."] },
                   "nodes": { "d": { "type": "dilate", "in": "dot", "radius": 1, "shape": "square" } },
                   "expect": ["111", "111", "111"])");
    expect_pass(R"("images": { "a": { "R": ["1."], "G": [[0.5, 0.25]], "B": 2, "A": 1 } },
                   "nodes": { "y": { "type": "ycolor", "in": "a", "weights": [1, 2, 4] } },
                   "expect": [[10, 8.5]], "tolerance": 1e-6)");
    expect_pass(R"("images": { "a": { "pattern": "ramp", "size": [5, 2] } }, "variables": { "k": 4 },
                   "nodes": { "m": { "type": "math", "in": "a", "op": "multiply", "value": "${k}" } },
                   "expect": ["01234", "01234"])");
}

TEST_F(GraphTests, WhatDiffersIsToldWithItsPlace) {
    EXPECT_EQ(
        fault_of(
            R"("images": { "dot": ["..", ".1"] }, "nodes": { "i": { "type": "math", "in": "dot", "op": "invert" } },
                          "expect": ["11", "11"])"),
        "tests.json:1:28: 't': failed: channel 'Y': 1 of 4 samples differ, the most at (1, 1): 0, expected "
        "1\n"
        "1 test, 1 failed\n");
    EXPECT_THAT(
        fault_of(R"("images": { "a": ["1"] }, "nodes": { "i": { "type": "math", "in": "a", "op": "invert" } },
                            "expect": { "R": [".."] })"),
        HasSubstr("there is no channel 'R'"));
    EXPECT_THAT(
        fault_of(
            R"("images": { "a": ["1"] }, "nodes": { "i": { "type": "math", "in": "a", "op": "invertt" } },
                            "expect": ["."])"),
        HasSubstr("failed: tests.json:1:112: error: node 'i' (math): 'op' is"));
}

TEST_F(GraphTests, ErrorsAndWarningsMayBeExpected) {
    expect_pass(R"("images": { "a": ["1"] }, "nodes": { "b": { "type": "gaussian", "in": "a", "sigma": -1 } },
                   "error": "'sigma' is -1")");
    EXPECT_THAT(fault_of(R"("images": { "a": ["1"] }, "nodes": { "b": { "type": "gaussian", "in": "a" } },
                            "error": "'sigma' is -1")"),
                HasSubstr("failed: no error says"));
    expect_pass(R"("images": { "a": ["1"] }, "output": "b",
                   "nodes": { "b": { "type": "math", "in": "a", "op": "abs" }, "c": { "type": "gaussian", "in": "a" } },
                   "warning": "nothing that is written uses it")");
}

TEST_F(GraphTests, AGraphIsGivenOtherImagesAndValues) {
    graph(
        R"("r": { "type": "read", "file": "plate.exr" }, "g": { "type": "grade", "in": "r", "multiply": "${gain}" },
             "b": { "type": "gaussian", "in": "g" }, "o": { "type": "write", "in": "g", "file": "o.exr" })",
        R"("variables": { "gain": 1 },)");
    const char* body =
        R"("graph": "graph.json", "images": { "r": { "R": ["12"], "G": ["34"], "B": ["56"] } }, "variables": { "gain": 2 },
                          "output": "g", "expect": { "R": ["24"], "G": ["68"] })";
    expect_pass(body);
    one(body);
    EXPECT_EQ(test({"--untouched"}).out, fmt::format("1 test, none failed\n{}: no test reaches 'b'\n",
                                                     (folder() / "graph.json").string()));
    EXPECT_FALSE(exists("o.exr"));
    one(R"("images": { "a": ["1"] }, "nodes": { "b": { "type": "math", "in": "a", "op": "abs" } }, "expect": ["1"])");
    EXPECT_EQ(test({"--untouched"}).out,
              "1 test, none failed\nmath: no test gives 'value', 'b', 'mix' and 'mask'\n");
}

TEST_F(GraphTests, BranchesOfAGraphThatNoTestTakesAreTold) {
    graph(
        R"("r": { "type": "read", "file": "plate.exr" },
             "soft": { "type": "gaussian", "in": "r", "enabled": "= look == 'final'" },
             "o": { "type": "write", "in": "soft", "file": "o.exr" })",
        R"("variables": { "look": { "default": "final", "choices": ["final", "rough"] } },)");
    const auto tested = [&](const std::string& variables) {
        one(fmt::format(R"("graph": "graph.json", "images": {{ "r": {{ "R": ["1"] }} }}, "output": "soft",
               "expect": ["1"]{})",
                        variables));
        return test({"--untouched"}).out;
    };
    const std::string file = (folder() / "graph.json").string();
    EXPECT_EQ(
        tested(""),
        fmt::format("1 test, none failed\n{}: no test has 'soft' not enabled and look = 'rough'\n", file));
    EXPECT_EQ(tested(R"(, "variables": { "look": "rough" })"),
              fmt::format("1 test, none failed\n{}: no test has 'soft' enabled and look = 'final'\n", file));
}

TEST_F(GraphTests, GoldenFilesAreBlessed) {
    one(R"("images": { "a": { "pattern": "noise", "size": [9, 7], "channels": ["R", "G", "B"] } },
           "nodes": { "b": { "type": "gaussian", "in": "a", "sigma": 2 } }, "expect": { "file": "golden/b.exr" })");
    EXPECT_THAT(test().out, HasSubstr("'golden/b.exr' is not there; --bless makes it"));
    EXPECT_EQ(test({"--bless"}).out, "tests.json:1:28: 't': blessed\n1 test, none failed\n");
    EXPECT_EQ(test().status, 0);
    one(R"("images": { "a": { "pattern": "noise", "size": [9, 7], "channels": ["R", "G", "B"] } },
           "nodes": { "b": { "type": "gaussian", "in": "a", "sigma": 3 } }, "expect": { "file": "golden/b.exr" })");
    EXPECT_EQ(test().status, 1);
    EXPECT_EQ(test({"--bless"}).status, 0);
}

TEST_F(GraphTests, ForProgramsThatRunTests) {
    write("tests.json", R"({ "keyline": 1, "tests": {
      "good": { "images": { "a": ["1"] }, "nodes": { "b": { "type": "math", "in": "a", "op": "abs" } }, "expect": ["1"] },
      "bad <1>": { "images": { "a": ["1"] }, "nodes": { "b": { "type": "math", "in": "a", "op": "abs" } }, "expect": ["2"] } } })");
    const Outcome run = test({"--tap", "--junit", "results.xml"});
    EXPECT_EQ(run.status, 1);
    EXPECT_EQ(run.out,
              "TAP version 14\n1..2\nok 1 - good\nnot ok 2 - bad <1>\n  ---\n  faults:\n    - \"channel 'Y': "
              "1 of 1 "
              "sample differ, the most at (0, 0): 1, expected 2\"\n  ...\n");
    const std::string xml = read(folder() / "results.xml");
    EXPECT_THAT(xml, HasSubstr(R"(<testsuite name="keyline" tests="2" failures="1">)"));
    EXPECT_THAT(xml, HasSubstr(R"(name="bad &lt;1&gt;")"));
    EXPECT_EQ(test({"--filter", "goo*"}).out, "1 test, none failed\n");
    EXPECT_EQ(test({"--threads", "2"}).status, 1);
}

TEST_F(GraphTests, WhatIsWrongWithAFileIsTold) {
    write("tests.json", R"({ "keyline": 1, "tests": {
      "a": { "nodes": { "b": { "type": "constant" } }, "expects": ["1"] },
      "b": { "nodes": { "b": { "type": "constant" } } },
      "c": { "expect": ["1"] },
      "d": { "images": { "a": ["1", "11"] }, "nodes": { "b": { "type": "math", "in": "a", "op": "abs" } }, "expect": ["1"] } } })");
    const Outcome run = test();
    EXPECT_EQ(run.status, 2);
    EXPECT_THAT(run.err, HasSubstr("tests.json:2:56: error: unknown key 'expects'; did you mean 'expect'?"));
    EXPECT_THAT(run.err, HasSubstr("tests.json:3:7: error: the test expects nothing"));
    EXPECT_THAT(run.err, HasSubstr("tests.json:4:7: error: a test has either a 'graph' or 'nodes'"));
    EXPECT_THAT(run.out, HasSubstr("tests.json:5:37: error: the row is 2 wide, the one before 1"));
}

}  // namespace

}  // namespace keyline::test
