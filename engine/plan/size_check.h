// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/base/error.h"
#include "engine/plan/resolve.h"

namespace KEYLINE_API keyline {

// What would keep a machine busy for hours is told before the first pixel: outputs far larger than what is
// displayed (a picture that was scaled up and not cropped) are warned of, and those that no disk holds are
// refused.
void check_sizes(const ResolvedFrame& frame, Diagnostics& diagnostics);

// What an output takes uncompressed.
double stored_bytes(const SinkSpec& spec);

}  // namespace keyline
