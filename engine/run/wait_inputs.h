// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/error.h"
#include "engine/plan/resolve.h"

#include <vector>

// Inputs that others are still making.

namespace keyline {

// Whether all that is wrong is that inputs are not whole.
bool may_come(const std::vector<Error>& errors);

// Tells of inputs whose files change while one looks.  Tables of chunks tell of OpenEXR files that all of
// them is there (check_inputs), and the structure of some other formats does; of the rest, files that were
// written to a moment ago are not at rest.
void check_at_rest(const ResolvedFrame& frame, Diagnostics& diagnostics);

}  // namespace keyline
