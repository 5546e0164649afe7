// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/graph.h"
#include "engine/resolve.h"

#include <span>

// No run writes a file twice, or onto a file that it reads.

namespace keyline {

// Within one frame.
void check_outputs(const ResolvedFrame& frame, Diagnostics& diagnostics);

// Between the frames of a run, before the first pixel: a later frame may read what an earlier one writes, as
// with `"frame": "-1"`.  Opens the files of all frames where names alone leave that open, which is rare.
void check_outputs(const Graph& graph, std::span<const int> frames, const ResolveOptions& options,
                   Diagnostics& diagnostics);

}  // namespace keyline
