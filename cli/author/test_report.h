// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cli/author/graph_test.h"

namespace keyline::cli {

// For people: what failed and why, and a line for all.
std::string results_as_text(const std::vector<GraphTest>& tests, const std::vector<TestResult>& results);

// For programs that run tests: TAP 14, and the XML of JUnit.
std::string results_as_tap(const std::vector<GraphTest>& tests, const std::vector<TestResult>& results);
std::string results_as_junit(const std::vector<GraphTest>& tests, const std::vector<TestResult>& results);

// Of the graphs, nodes that no output is made of; of the types of nodes, parameters that no test gives.
std::string untouched_text(const std::vector<GraphTest>& tests, const std::vector<TestResult>& results);

}  // namespace keyline::cli
