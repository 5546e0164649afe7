// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/kit/strokes.h"
#include "tests/support/run.h"

#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

// Nodes that take or make strokes, on strokes in memory.

namespace keyline::testing {

using Places = std::vector<std::pair<double, double>>;

Stroke stroke(const Places& places, double width = 1, StrokeKind kind = StrokeKind::kOutline,
              bool closed = false);

// In a frame of which display and data window are the same.
Strokes strokes_in(const Rect& window, std::vector<Stroke> strokes);

// A few strokes with some of everything, in and around a window; the same for the same seed.
Strokes random_strokes(unsigned seed, const Rect& window);

// The node that gives random_strokes(), for graphs of tests: {"type": "random_strokes", "seed": 3}.
void register_random_strokes();

// One node with its parameters on strokes; further inputs are images by port name.
Strokes run_on_strokes(const std::string& type, const Json& params, const Strokes& in,
                       const RunOptions& options = {}, const std::map<std::string, Image>& images = {});
Image draw_strokes(const std::string& type, const Json& params, const Strokes& in,
                   const RunOptions& options = {}, const std::map<std::string, Image>& images = {});

}  // namespace keyline::testing
