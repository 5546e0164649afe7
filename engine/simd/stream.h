// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace keyline::simd {

// Copies n floats to memory that is not read again soon; past the caches where that is faster, as lines that
// are written whole are not fetched first.  finish_stream() comes after the last row and before another
// thread may read.
void stream_row(const float* from, float* to, int n);
void finish_stream();

}  // namespace keyline::simd
