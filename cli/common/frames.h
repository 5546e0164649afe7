// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/graph/graph.h"

#include <string>
#include <vector>

namespace keyline::cli {

// What stands for frames in a --frames option: itself, what is in a file (`@FILE`) or comes by standard input
// (`-`), where ends of lines part them like commas.  "" for an empty list.  Throws Failure (kGraph) for a
// file that can't be read.
std::string frames_text(const std::string& option);

// The option that stands for every frame on disk.
inline constexpr const char* kAllFrames = "all";

// The frames that a render runs.  Without --frames (`given` empty) it is frame 1, which then stands nowhere:
// an error where something that is run names or uses the frame.
std::vector<int> frames_to_render(const Graph& graph, const std::vector<int>& given,
                                  Diagnostics& diagnostics);

// The frames that check and plan look at: without --frames the first one on disk.  `note` says which was
// chosen; it stays empty where there was no choice.
std::vector<int> frames_to_check(const Graph& graph, const std::vector<int>& given, std::string& note);

}  // namespace keyline::cli
