// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/registry.h"

namespace keyline {

void Registry::add(NodeType type) {
    std::string name = type.name;
    if (!types_.emplace(name, std::move(type)).second)
        fail(ErrorKind::kInternal, "two node types are named " + in_quotes(name));
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

Registry& registry() {
    static Registry the_registry = [] {
        Registry r;
        for (NodeType& type : built_in_nodes()) r.add(std::move(type));
        return r;
    }();
    return the_registry;
}

}  // namespace keyline
