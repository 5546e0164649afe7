// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/base/index.h"
#include "engine/plan/resolve.h"

#include <vector>

namespace KEYLINE_API keyline {

// What of each value the sinks need: a region of pixels; a datum as a whole or not at all.
struct Demand {
    std::vector<std::vector<Rect>> regions;  // by operation and output; empty: not needed
    std::vector<bool> data;                  // by operation: whether its datum is needed

    const Rect& of(ValueRef v) const { return regions[index(v.op)][index(v.output)]; }
    bool needs(std::size_t op) const;   // any of its outputs
    Rect region(std::size_t op) const;  // of all its outputs
};

// Backward from the sinks: a region outside a value's data window is never demanded.  A gather that is needed
// needs all of its inputs.
Demand demand(const ResolvedFrame& frame);

// The region of one value of a link that `out` of its operation is computed from.
Rect demand_of_link(const Op& op, int slot, const Rect& out);

// What compute() sees of a link for `out`: exactly `out` where the operation looks nowhere else, else what it
// demands as far as the picture goes.  Outside the link's data window it sees 0.
Rect view_of_link(const Op& op, int slot, const Rect& out);

// The window that the views of a link tell.
Rect end_of_link(const Op& op, int slot);

}  // namespace keyline
