// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/error.h"
#include "engine/json/value.h"

#include <optional>

namespace keyline {

// A value that moves:
//
//     { "keys": [[1001, 1], [1024, 3, "smooth"], [1040, 2]], "before": "hold", "after": "loop", "on": 2 }
//
// The word says how it goes on from that key to the next.  In its place a key may have tangents, the inner
// points of a cubic Bézier curve as seen from it: { "in": [FRAMES, RISE], "out": [FRAMES, RISE] }.
bool is_animation(const Value& value);

// What it is at a frame, with the place of the whole; nothing where it is wrong, which is told.
std::optional<Value> animated(const Value& animation, int frame, Diagnostics& diagnostics);

// Tells what is wrong with it at any frame; its keys may hold what is not known yet.
bool check_animation(const Value& animation, Diagnostics& diagnostics);

}  // namespace keyline
