// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/graph.h"

#include <string>
#include <vector>

namespace keyline::cli {

// The frames that a render runs.  Without --frames (`given` empty) it is frame 1, which then stands nowhere:
// an error where something that is run names or uses the frame, and where several frames would be written to
// one file.
std::vector<int> frames_to_render(const Graph& graph, const std::vector<int>& given,
                                  Diagnostics& diagnostics);

// The frames that check and plan look at: without --frames the first one on disk.  `note` says which was
// chosen; it stays empty where there was no choice.
std::vector<int> frames_to_check(const Graph& graph, const std::vector<int>& given, std::string& note,
                                 Diagnostics& diagnostics);

}  // namespace keyline::cli
