// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

// The instruction sets that the row kernels of engine/simd were built for.  Each kernel has one body,
// compiled once for each of them; the best that the processor has is chosen when the program runs.  All give
// the same bits, so the choice is about time alone.

namespace keyline::simd {

// Those that this processor can run, best first: "AVX2", "SSE4", …  The first is the one that runs.
std::vector<std::string> targets();

// Runs every kernel on the named one from now on, or on the best again for "".  For tests and benchmarks: no
// kernel may be running.  Throws Failure for a name that is not among targets().
void use_target(const std::string& name);

}  // namespace keyline::simd
