// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/resolve.h"

#include <vector>

namespace keyline {

// What of each value the sinks need.
struct Demand {
    std::vector<std::vector<Rect>> regions;  // by operation and output; empty: not needed

    const Rect& of(ValueRef v) const {
        return regions[static_cast<std::size_t>(v.op)][static_cast<std::size_t>(v.output)];
    }
    bool needs(std::size_t op) const;
    Rect region(std::size_t op) const;  // of all its outputs
};

// Backward from the sinks: a region outside a value's data window is never demanded.
Demand demand(const ResolvedFrame& frame);

// The region of one value of a link that `out` of its operation is computed from.
Rect demand_of_link(const Op& op, int slot, const Rect& out);

// What compute() sees of a link for `out`: exactly `out` where the operation looks nowhere else (0 outside
// the link's window), else what it demands inside the window.
Rect view_of_link(const Op& op, int slot, const Rect& out);

}  // namespace keyline
