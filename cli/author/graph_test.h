// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/graph/graph.h"
#include "engine/json/value.h"
#include "engine/look/differences.h"

#include <optional>
#include <set>
#include <string>
#include <vector>

namespace keyline::cli {

// One test of a graph or of nodes by themselves, as its file has it.
struct GraphTest {
    std::string name, file;       // of the test, and that it stands in
    std::string folder;           // what its paths are relative to
    std::string graph;            // empty: `nodes`
    Value nodes, images, values;  // objects; `values` are of variables
    std::vector<Member> set;      // "NODE.NAME" and the value
    std::string output;           // "NODE" or "NODE:LAYER"
    int frame = 1;
    std::optional<Value> expected;  // an image
    Tolerance tolerance;
    std::string error, warning;  // texts that have to be told; empty: none
    Place place;
};

// The tests of a file.  What is wrong with one goes to the diagnostics, and leaves that one out.
std::vector<GraphTest> read_graph_tests(const std::string& file, Diagnostics& diagnostics);

struct TestResult {
    std::vector<std::string> faults;  // none: it passed
    bool blessed = false;             // the file that it expects was written
    double seconds = 0;
    std::set<std::string> reached;     // nodes of the graph that the output is made of
    std::set<std::string> branches;    // ways of the graph that it took; see branches_of()
    std::set<std::string> parameters;  // "TYPE.NAME" that nodes of the test were given
};

// The ways that a graph has: "look = 'final'" for each choice of a variable, "'soft' enabled" and "'soft' not
// enabled" for each node that says it.  Those that it takes at a frame are in `taken`.
struct Branches {
    std::set<std::string> all, taken;
};
Branches branches_of(const Graph& graph, int frame);

// With `bless`, an expected file becomes what was made.
TestResult run_graph_test(const GraphTest& test, bool bless);

}  // namespace keyline::cli
