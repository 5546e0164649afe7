// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/node/node_type.h"

#include <span>
#include <string>

namespace keyline::cli {

// The reference for programs: a list with an object a type.
std::string nodes_json(std::span<const NodeType> types);

}  // namespace keyline::cli
