// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/node/node_type.h"

#include <optional>
#include <string>

// Pixels and the kinds of data: whether a link joins what fits, and what would make it fit.

namespace keyline {

struct KindFault {
    std::string what, hint;
};

// What is wrong where the port `port`, which takes `takes`, is linked to a node `from` of type `type`.  The
// hint names the registered nodes that turn the one into the other.
std::optional<KindFault> kind_fault(const std::string& port, const Takes& takes, const std::string& from,
                                    const NodeType& type);

// The same where the link picks something of the node's data by a name after a colon.
std::optional<KindFault> selector_fault(const std::string& from, const NodeType& type,
                                        const std::string& selector);

}  // namespace keyline
