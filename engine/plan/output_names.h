// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/graph/graph.h"

#include <filesystem>
#include <span>
#include <vector>

namespace keyline {

// The files that the frames of a run are written to, without resolving a frame.
class OutputNames {
public:
    struct Output {
        int sink;  // of Graph::sinks(), by node
        std::filesystem::path file;
    };

    // `graph` must outlive it.
    OutputNames(const Graph& graph, std::span<const int> frames);

    // As many, in the same order, for every frame; none for a frame whose parameters are faulty.
    std::vector<Output> at(int frame) const;

private:
    const Graph& graph_;
    FrameNodes first_;        // the nodes of the first frame
    bool are_fixed_ = false;  // their names hold for all frames: no ${frame} stands in one
};

// Whether the file names of a node are the same text for two frames; a ${frame} in one makes it another text
// for every frame.
bool has_fixed_names(const Node* at_first, const Node* at_last);

}  // namespace keyline
