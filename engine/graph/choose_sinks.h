// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/graph/graph.h"

#include <string>
#include <vector>

namespace keyline {

// Tells of nodes that have nothing to pass on where they are not enabled.
void check_enabled(const Graph& graph, int frame, Diagnostics& diagnostics);

// Whether the graph has a node that writes, whatever the options choose.
bool has_sink(const std::vector<GraphNode>& nodes);

// Tells, at `place`, that it has none.
void report_no_sink(const Place& place, Diagnostics& diagnostics);

// The nodes to be written: those of --output where there are some, else those of --only, else all; in the
// file's order.  What --only names and is no output is told.
std::vector<int> choose_sinks(const std::vector<GraphNode>& nodes, const LoadOptions& options,
                              Diagnostics& diagnostics);

// Warns of nodes that nothing that is written needs, but not of those that another choice of a variable
// names.
void warn_of_unused(const Graph& graph, Diagnostics& diagnostics);

// Warns of the variables of a graph, whose file says `root`, that nothing uses.
void warn_of_unused_variables(const Value& root, const Graph& graph, Diagnostics& diagnostics);

}  // namespace keyline
