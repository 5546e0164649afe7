// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/kit/strokes.h"

#include <vector>

namespace KEYLINE_API keyline {

// The strokes without those parts that run within `within` pixels along one that stands before it in the
// list; what is left of a stroke that was cut, is shorter than `least` pixels and leads to no other line goes
// too.
std::vector<Stroke> without_doubles(std::vector<Stroke> strokes, double within, double least);

}  // namespace keyline
