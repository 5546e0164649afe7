// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/error.h"

#include <string>
#include <vector>

namespace keyline::cli {

// What was found out about one graph.
struct CheckedGraph {
    std::string file;
    Diagnostics diagnostics;
};

// For programs: a list with an object a graph.
std::string messages_json(const std::vector<CheckedGraph>& graphs);

// For code review: SARIF 2.1.0.
std::string messages_sarif(const std::vector<CheckedGraph>& graphs);

}  // namespace keyline::cli
