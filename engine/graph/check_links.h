// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/graph/graph.h"

#include <set>
#include <string>
#include <vector>

namespace keyline {

struct Links {
    std::vector<std::vector<int>> of;  // the nodes that each node reads
    std::set<int> misfits;             // nodes that are linked to another kind of value than they take
    bool known = true;                 // else a node may be in use that does not look so
};

// Follows the inputs of all nodes, as they stand at a frame.  They come from the declarations, so that the
// inputs of a node are checked whatever else is wrong with it; what is wrong with their form was told.
Links check_links(const std::vector<GraphNode>& nodes, const std::set<std::string>& unknown_ids, int frame,
                  Diagnostics& diagnostics);

// Every node after those it reads; nodes that form a cycle are told.
std::vector<int> order_by_links(const std::vector<GraphNode>& nodes,
                                const std::vector<std::vector<int>>& links, Diagnostics& diagnostics);

}  // namespace keyline
