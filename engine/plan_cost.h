// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/plan.h"

namespace keyline {

// What a plan costs in time, by a model with few constants.  It ranks the plans of one frame; as a forecast
// it is as good as the machine is like the one that the constants were measured on.

// Fills in the plan's estimate of its work: seconds of one thread.
void estimate_work(Plan& plan);

// Pixels computed over pixels wanted, weighted by what the operations cost: 1 without halos.
double halo_overhead(const Plan& plan, const Sweep& sweep);

}  // namespace keyline
