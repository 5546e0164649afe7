// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/plan/plan.h"

namespace keyline {

// What a plan costs in time, by a model with few constants.  It ranks the plans of one frame; as a forecast
// it is as good as the machine is like the one that the constants were measured on.

// Fills in the sweeps' and the plan's estimates of time, on the plan's number of threads.
void estimate_time(Plan& plan);

// What making again in a coming frame would cost of that which the plan leaves for it; at least so much.
double carrying_saves(const Plan& plan);

// What computing a sweep in its tiles costs against computing it in one piece: 1 where no tile does again
// what its neighbours do.  A larger tile can gain no more than this.
double tiling_overhead(const Plan& plan, const Sweep& sweep);

}  // namespace keyline
