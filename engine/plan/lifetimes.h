// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/plan/kept.h"

#include <vector>

namespace keyline {

// When each datum that is needed is made, and who reads it last; data of earlier frames that are read.
std::vector<PlannedDatum> plan_data(const ResolvedFrame& frame, const Carrying& carrying,
                                    const Schedule& schedule, const Division& division);

}  // namespace keyline
