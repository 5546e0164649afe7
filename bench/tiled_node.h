// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/memory_graph.h"
#include "engine/plan/plan.h"

namespace keyline::bench {

// A node alone: its operation on the tiles that the planner cuts, by one thread, without what the engine does
// around it.  For nodes that compute one channel of one input.
class TiledNode {
public:
    // As for MemoryGraph, of the one node "result".
    TiledNode(const std::string& nodes, const Picture& picture);

    // Computes the whole picture, each tile into the same memory.
    void run();

private:
    void compute(const Rect& tile);

    MemoryGraph graph_;
    Plan plan_;
    const Op* op_;
    Rect window_;
    std::vector<float> samples_, tile_;  // of the picture, of what is computed
    Scratch scratch_;
};

}  // namespace keyline::bench
