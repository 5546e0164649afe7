// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/graph/graph.h"

#include <optional>

namespace keyline {

// What `enabled` says of a node, or of a group where it is used, at a frame.  Nothing where that can't be
// told, which is a fault.
std::optional<bool> is_enabled_at(const GraphNode& node, int frame, Diagnostics& diagnostics);

// Whether that depends on the frame.
bool enabled_moves(const GraphNode& node);

}  // namespace keyline
