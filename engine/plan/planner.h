// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/plan/plan.h"

#include <cstddef>
#include <span>

namespace keyline {

// Chooses among the plans of a frame: from the fastest to the smallest, the first that fits the memory.

struct PlanOptions {
    int threads = 1;
    int tile = 0;            // 0: the planner's choice
    std::size_t memory = 0;  // bytes for the whole process; 0: no limit
    bool weigh_all = false;  // for people: what there was to choose from, too
    // What earlier frames of the run left, and those that come.
    std::span<const Carried> held = {};
    std::span<const ComingFrame> coming = {};
    std::size_t at_work = 0;  // bytes of frames that still run; what they leave is counted in them
};

// Throws Failure (kGraph) where the memory is less than the least that the frame can be computed in.
Plan make_plan(ResolvedFrame frame, const PlanOptions& options);

}  // namespace keyline
