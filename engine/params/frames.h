// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"

#include <string>
#include <string_view>
#include <vector>

namespace KEYLINE_API keyline {

// The frames of a --frames option: `A`, `A-B`, `A-BxS`, joined by commas, with blanks between the numbers and
// signs allowed; A and B may be negative.  `A-B:S` is the same as `A-BxS`: render farms write either.  Where
// B is less than A it goes down.  In the order given, each once.  Throws Failure (kGraph) quoting the spec
// for anything else, S < 1, and more than a million frames.
std::vector<int> parse_frames(std::string_view spec);

// For messages: "1-4, 7, 10-20x5".  Frames keep their order; parse_frames reads it again.
std::string format_frames(const std::vector<int>& frames);

}  // namespace keyline
