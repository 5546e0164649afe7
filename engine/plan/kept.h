// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/plan/schedule.h"

#include <map>
#include <set>
#include <vector>

namespace keyline {

// What one sweep reads from stores, and the operations that it computes.
struct SweepWork {
    std::set<ValueRef> loads;
    std::set<int> ops;
};

// Who computes what: each sweep its own work, and the computed values that outlive the sweep that made them.
struct Division {
    struct Span {
        int made = 0, last = 0;  // sweeps
    };
    std::vector<SweepWork> work;  // by sweep
    std::map<ValueRef, Span> kept;
};

// `keep` says whether a later sweep may have results of stencils from stores; else it computes them again.
// What coming frames want is kept in any case.
Division divide_work(const ResolvedFrame& frame, const Demand& demand, const Carrying& carrying,
                     const Schedule& schedule, bool keep);

}  // namespace keyline
