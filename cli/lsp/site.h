// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cli/lsp/document.h"
#include "engine/graph/group.h"
#include "engine/node/node_type.h"

#include <memory>
#include <string>
#include <vector>

namespace keyline::lsp {

// Where a cursor stands.
struct Site {
    enum class Part { kKey, kValue };

    Part part = Part::kValue;
    std::vector<const JsonItem*>
        path;  // from a member of the whole inwards; the last is what the cursor is in
    const JsonTree* container = nullptr;  // that holds that item, or that a new one would be of
    const JsonItem* item = nullptr;       // null: a new one would begin here
    Span token = {};  // the key, string or word that the cursor touches; empty where it is none
};

// Null container: outside of everything.
Site site_at(const Document& document, std::size_t byte);

// What a node is: its type, and for a group the file that declares it.
struct NodeMeaning {
    const NodeType* type = nullptr;  // null: unknown
    std::shared_ptr<const Group> group;
};

NodeMeaning meaning_of_node(const Document& document, const JsonTree& node);

// What is declared for what stands at the end of a path: a value of a node's parameter, or a part of one.
struct Meaning {
    const JsonItem* node = nullptr;  // null: it is of no node
    NodeMeaning of_node;
    const FieldInfo* field = nullptr;
    const TypeInfo* type = nullptr;  // null: nothing is declared
};

Meaning meaning_of(const Document& document, const std::vector<const JsonItem*>& path);

}  // namespace keyline::lsp
