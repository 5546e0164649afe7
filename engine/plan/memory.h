// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/plan/plan.h"

#include <string>

namespace KEYLINE_API keyline {

// Fills in the sweeps' and the plan's estimates of memory: of the process and all its helpers together.
void estimate_memory(Plan& plan);

// "512M", "1.5G": rounded up, so that giving it back as --memory is enough.
std::string memory_text(std::size_t bytes);

}  // namespace keyline
