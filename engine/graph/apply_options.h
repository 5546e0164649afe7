// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/graph/graph.h"

#include <string>
#include <utility>
#include <vector>

namespace keyline {

// The --var options as values; one that is no value is told and left out.
std::vector<std::pair<std::string, Value>> variable_overrides(const std::vector<OptionValue>& options,
                                                              Diagnostics& diagnostics);

// Puts what --set says into the nodes.
void apply_set_options(const std::vector<OptionValue>& options, std::vector<GraphNode>& nodes,
                       Diagnostics& diagnostics);

// Adds a sink for each --output.
void add_outputs(const LoadOptions& options, const std::shared_ptr<const Scope>& scope,
                 std::vector<GraphNode>& nodes);

// For hints.
std::vector<std::string> ids_of(const std::vector<GraphNode>& nodes);

}  // namespace keyline
