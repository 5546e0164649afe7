// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/plan/resolve.h"
#include "tests/support/image.h"

#include <memory>
#include <vector>

namespace keyline::testing {

// The images that a frame's sinks get (an empty one for a sink of data), computed the plainest way: one
// operation after the other, each over its whole data window at once, everything in memory as floats.  No
// plan, no tiles, no stores, no threads; what the engine makes must be the same, bit for bit.
std::vector<Image> interpret(const ResolvedFrame& frame);

// Likewise with the data of all operations; null where one makes pixels.
struct Interpretation {
    std::vector<Image> images;                       // by sink
    std::vector<std::shared_ptr<const Datum>> data;  // by operation
};
Interpretation interpret_all(const ResolvedFrame& frame);

}  // namespace keyline::testing
