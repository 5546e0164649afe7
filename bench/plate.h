// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/memory_graph.h"

#include <string>

namespace keyline::bench {

// The beauty pass of a plate: R G B A of ViewLayer.Combined.  Throws what OpenEXR throws.
Picture read_beauty(const std::string& file);

// What strokes are made of: its first Cryptomatte of objects, the normals and the depth.
Picture read_passes(const std::string& file);

// Luminance of a beauty pass (Rec. 709), limited to 0 … 1: one channel, Y.
Picture grey_of(const Picture& beauty);

// 1 where a one-channel picture is above `level`, 0 elsewhere: a mask of two values.
Picture mask_of(const Picture& grey, float level);

}  // namespace keyline::bench
