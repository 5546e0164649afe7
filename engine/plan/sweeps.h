// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/plan/plan.h"

namespace keyline {

// What the planner may trade for memory, and never pixels.
struct Choices {
    bool keep_sources = true;   // decoded samples that a later sweep needs again, or decode again
    bool keep_computed = true;  // likewise results of stencils, or compute them again
    int tile_width = 256, tile_height = 64;
    int rows_ahead = 2;
    bool carry = true;  // from frame to frame, or make everything in each
};

// Fills in the stores, data and sweeps of a plan whose frame, demand and carrying are there.
void make_sweeps(Plan& plan, const Choices& choices);

}  // namespace keyline
