// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/node_type.h"

#include <map>
#include <string_view>

namespace keyline {

// The kinds of node that graphs can name.  Filled with Keyline's own before main's first use; a program may
// add more before it loads a graph.
class Registry {
public:
    void add(NodeType type);  // throws Failure (kInternal) for a name given twice

    const NodeType* find(std::string_view name) const;  // null where there is none
    std::vector<std::string> names() const;             // sorted
    const std::map<std::string, NodeType, std::less<>>& types() const { return types_; }

private:
    std::map<std::string, NodeType, std::less<>> types_;
};

Registry& registry();

// Generated from nodes/CMakeLists.txt.
std::vector<NodeType> built_in_nodes();

}  // namespace keyline
