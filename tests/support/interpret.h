// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/resolve.h"
#include "tests/support/image.h"

#include <vector>

namespace keyline::testing {

// The images that a frame's sinks get, computed the plainest way: one operation after the other, each over
// its whole data window at once, everything in memory as floats.  No plan, no tiles, no stores, no threads;
// what the engine makes must be the same, bit for bit.
std::vector<Image> interpret(const ResolvedFrame& frame);

}  // namespace keyline::testing
