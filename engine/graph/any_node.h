// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/graph/graph.h"

#include <string>

namespace keyline {

// Takes `type` and what else any node may have out of its object: `about`, `enabled` and `meant`.  `title` is
// what messages call the node.
void take_what_any_node_has(GraphNode& node, const std::string& title, Diagnostics& diagnostics);

}  // namespace keyline
