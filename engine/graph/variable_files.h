// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/graph/graph.h"

namespace keyline {

// All that gives variables their values: the graph itself, the files that it includes, those of --vars, and
// --var.  A relative name in the graph begins at `folder`.  What can't be read is told.
VariableSources variable_sources(const Value& root, const LoadOptions& options,
                                 const std::filesystem::path& folder, Diagnostics& diagnostics);

}  // namespace keyline
