// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/base/error.h"
#include "engine/json/value.h"
#include "engine/node/node_type.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace KEYLINE_API keyline {

// A graph file that is a node type: what it takes, as a node declares it, and what it gives.
struct Group {
    struct Output {
        std::string name;
        Value link;  // to one of its nodes, as written
    };

    std::filesystem::path file;
    Value root;                   // the whole file
    NodeType type;                // inputs, then parameters; it makes no node
    std::vector<Output> outputs;  // the first is what the group's id alone means

    bool has_input(std::string_view name) const;
};

// The version that a group's file says; nothing where it says none, or what is none.
std::optional<int> version_of_group(const Value& root);

// Reads a group's file.  What is wrong with its declarations is told; null where it can't be read at all.
std::shared_ptr<const Group> read_group(const std::filesystem::path& file, const Place& use,
                                        Diagnostics& diagnostics);

// The same of what a text says, which has 'nodes' and 'keyline'.
std::shared_ptr<const Group> group_from(const std::filesystem::path& file, const Value& root,
                                        Diagnostics& diagnostics);

}  // namespace keyline
