// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/plan.h"

#include <string>

namespace keyline {

// Fills in the sweeps' and the plan's estimates of memory.
void estimate_memory(Plan& plan);

// Rows of a store that are held at once while a sweep goes over it.
int live_rows(const Plan& plan, const Sweep& sweep, const Store& store);

// "512M", "1.5G": rounded up, so that giving it back as --memory is enough.
std::string memory_text(std::size_t bytes);

}  // namespace keyline
