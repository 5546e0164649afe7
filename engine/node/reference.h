// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/node/node_type.h"

#include <string>
#include <vector>

// The node reference, written from the nodes' own declarations: nothing here knows a node by name.  The
// groups that it tells of are given.

namespace KEYLINE_API keyline {

// All types with a sentence each, by kind, for the terminal.
std::string node_list_text(const std::vector<NodeType>& groups = {});

// One type with its inputs, parameters and outputs, for the terminal.
std::string node_text(const NodeType& type);

// All types in full, as Markdown.
std::string reference_markdown(const std::vector<NodeType>& groups = {});

// The JSON Schema (draft 2020-12) of a graph file, for editors.
std::string schema_json(const std::vector<NodeType>& groups = {});

}  // namespace keyline
