// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/graph/graph.h"
#include "engine/plan/resolve.h"

#include <span>

// What is wrong with the files of a run, found before its first pixel: none is written twice, or onto one
// that is read; inputs are whole, and outputs can be made.

namespace keyline {

// Within one frame.
void check_outputs(const ResolvedFrame& frame, Diagnostics& diagnostics);

// Whether the inputs have all that is read of them, as far as their tables of chunks tell.
void check_inputs(const Graph& graph, const ResolvedFrame& frame, Diagnostics& diagnostics);

// What is known beforehand to keep the outputs of one frame from being written: permissions, or what stands
// in their places.
void check_places(const ResolvedFrame& frame, Diagnostics& diagnostics);

// Between the frames of a run, before the first pixel: several may be written to one file, and a later frame
// may read what an earlier one writes, as with `"frame": "-1"`.  Opens the files of all frames where names
// alone leave that open, which is rare; else a million frames take no longer than two.
void check_outputs(const Graph& graph, std::span<const int> frames, const ResolveOptions& options,
                   Diagnostics& diagnostics);

}  // namespace keyline
