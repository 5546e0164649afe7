// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/graph/read_nodes.h"

namespace keyline {

// Puts the nodes of groups in the place of those whose type is a file, group inside group; those become
// ReadGraph::groups.  `scope` is the graph's own.
void expand_groups(const LoadOptions& options, const std::shared_ptr<Scope>& scope, ReadGraph& read,
                   Diagnostics& diagnostics);

}  // namespace keyline
