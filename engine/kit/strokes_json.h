// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/kit/strokes.h"

#include <string>
#include <string_view>

// Strokes as JSON, for people and their scripts to change: lossless, one file a frame.
//
//     {
//       "strokes": 1,
//       "display": [0, 0, 1280, 720], "window": [0, 0, 1280, 720],
//       "objects": { "3e8a91f0": "Suzanne" },
//       "lines": [
//         { "kind": "outline", "near": "Suzanne", "closed": true, "width": 2.5,
//           "points": [[10.5, 20.5], [11.5, 20.25]], "depth": [4.1, 4.2] }
//       ]
//     }
//
// What each vertex has is one number where it is the same for all, else a list; what has its default is left
// out.  Arc and u follow from the points.

namespace KEYLINE_API keyline {

std::string strokes_json(const Strokes& strokes);

// Arranged.  Throws Failure (kInput) with the place in `file` of what is no such text.
Strokes parse_strokes(std::string_view text, const std::string& file);

}  // namespace keyline
