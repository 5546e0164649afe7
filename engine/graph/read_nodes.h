// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/graph/graph.h"

#include <optional>
#include <set>
#include <string>
#include <vector>

namespace keyline {

struct Group;

// What a graph file says, before links are followed.
struct ReadGraph {
    std::vector<GraphNode> nodes;                           // of known types; those of --output last
    std::vector<GraphNode> groups;                          // as they are used
    std::vector<std::shared_ptr<const Group>> group_files;  // what their types are of
    std::shared_ptr<const Scope> scope;
    std::string ocio;                   // as written; empty where there is none
    std::set<std::string> unknown_ids;  // nodes whose type is wrong: told once, not again by their users
};

// Reads a graph file, which lies in `folder`, with the options that change it.  Nothing where its version is
// not known: what the rest means can't be told then.  Every fault goes to the diagnostics.
std::optional<ReadGraph> read_nodes(const Value& root, const LoadOptions& options,
                                    const std::filesystem::path& folder, Diagnostics& diagnostics);

}  // namespace keyline
