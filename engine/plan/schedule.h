// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/plan/plan.h"

#include <vector>

namespace keyline {

// A root of a sweep, and the values that it is computed from.
struct RootNeed {
    Root root;
    std::vector<ValueRef> values;
};

// Which sweeps a frame takes and what each is for: gathers that are mapped in it, sinks that are written.
// It follows from the graph alone; what the planner may choose comes after.
struct Schedule {
    std::vector<std::vector<RootNeed>> roots;  // by sweep
    std::vector<int> available;                // by operation: the first sweep that can have its result

    int sweeps() const { return static_cast<int>(roots.size()); }
    int first_sweep_of_gather(const ResolvedFrame& frame, int op) const {
        const auto i = static_cast<std::size_t>(op);
        return available[i] - frame.ops[i].gather->rounds();
    }
};

// What an earlier frame made is there from the start, and so is what only that was made of.
Schedule make_schedule(const ResolvedFrame& frame, const Carrying& carrying);

}  // namespace keyline
