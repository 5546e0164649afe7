// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/node/registry.h"

#include <algorithm>

namespace keyline {

void Registry::add(NodeType type, std::string_view room) {
    std::string name = type.name;
    if (!types_.emplace(name, std::move(type)).second)
        fail(ErrorKind::kInternal, "two node types are named " + in_quotes(name));
    auto it = std::ranges::find(rooms_, room, &RoomNames::room);
    if (it == rooms_.end()) it = rooms_.insert(rooms_.end(), {std::string(room), {}});
    it->types.insert(std::ranges::lower_bound(it->types, name), name);
}

const NodeType* Registry::find(std::string_view name) const {
    const auto it = types_.find(name);
    return it == types_.end() ? nullptr : &it->second;
}

std::vector<std::string> Registry::names() const {
    std::vector<std::string> out;
    for (const auto& [name, type] : types_) out.push_back(name);
    return out;
}

std::vector<std::string> Registry::rooms() const {
    std::vector<std::string> out;
    for (const RoomNames& r : rooms_) out.push_back(r.room);
    return out;
}

std::vector<const NodeType*> Registry::types_in(std::string_view room) const {
    std::vector<const NodeType*> out;
    const auto it = std::ranges::find(rooms_, room, &RoomNames::room);
    if (it != rooms_.end())
        for (const std::string& name : it->types) out.push_back(find(name));
    return out;
}

Registry& registry() {
    static Registry the_registry = [] {
        Registry r;
        for (Room& room : built_in_nodes())
            for (NodeType& type : room.types) r.add(std::move(type), room.name);
        return r;
    }();
    return the_registry;
}

}  // namespace keyline
