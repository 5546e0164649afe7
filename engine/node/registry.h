// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/node/node_type.h"

#include <map>
#include <string_view>

namespace KEYLINE_API keyline {

// A folder of nodes/: the nodes that a user looks for under one heading.
struct Room {
    std::string name;  // "lines"
    std::vector<NodeType> types;
};

// The kinds of node that graphs can name.  Filled with Keyline's own when it is first asked for; a program
// may add more before it loads a graph.
class Registry {
public:
    // Throws Failure (kInternal) for a name given twice.  A room that is not there yet is opened as the last.
    void add(NodeType type, std::string_view room = "others");

    const NodeType* find(std::string_view name) const;  // null where there is none
    std::vector<std::string> names() const;             // sorted
    const std::map<std::string, NodeType, std::less<>>& types() const { return types_; }

    // In the order in which people meet them; a room's types are sorted.
    std::vector<std::string> rooms() const;
    std::vector<const NodeType*> types_in(std::string_view room) const;

private:
    struct RoomNames {
        std::string room;
        std::vector<std::string> types;
    };
    std::map<std::string, NodeType, std::less<>> types_;
    std::vector<RoomNames> rooms_;
};

Registry& registry();

// Generated from the folders of nodes/.
std::vector<Room> built_in_nodes();

}  // namespace keyline
