// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/node/node_type.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

// Where the groups are that graphs use: those that come with Keyline, those of a show, and a graph's own.

namespace KEYLINE_API keyline {

// Whether a node's type means a file; else it is a name, of a node or of a group.
inline bool is_group_file(std::string_view type) { return type.ends_with(".json"); }

// The file of the group that a type means in a graph of `folder`; empty where it means a node, or nothing.
//
// A file, "groups/ink.json", is looked for there, then in the folders of $KEYLINE_PATH, then among the
// shipped graphs; where there is none, the answer is the first place.  A name, "canny" or "canny@2", is that
// of a group in the folders of $KEYLINE_PATH or of the shipped groups.  Nodes have their names first.
std::filesystem::path group_file(const std::string& type, const std::filesystem::path& folder);

struct NamedGroup {
    std::string
        name;  // "canny"; "canny@2" where it is an earlier version, which the plain name does not mean
    std::filesystem::path file;
};

// All groups that have a name, sorted: what $KEYLINE_PATH has and what is shipped.
std::vector<NamedGroup> named_groups();

// Just those that come with Keyline.
std::vector<NamedGroup> shipped_groups();

// What they take, as nodes declare it, under their names.  Those with faults are left out: who uses one is
// told.
std::vector<NodeType> types_of(const std::vector<NamedGroup>& groups);

// For messages: what may have been meant by a type that is neither a node's nor a group's.
std::string near_type(const std::string& type, const std::filesystem::path& folder);

}  // namespace keyline
