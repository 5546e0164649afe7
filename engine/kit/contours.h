// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/kit/borders.h"
#include "engine/kit/strokes.h"

#include <array>
#include <vector>

// From the planar map of borders to strokes: whose each is, of which kind, and where exactly it runs.

namespace KEYLINE_API keyline {

struct ContourOptions {
    double sigma = 0.7;                // of the blur that crossings were found with, in pixels
    double pixel_angle = 0;            // what a pixel covers at depth 1
    std::array<double, 2> step{1, 3};  // in pixels of the nearer side: a border with less is an intersection,
                                       // one with more an outline; between them it is as what it hangs on
    double min_length = 4;             // closed lines that are shorter are left out
    double epsilon = 0.05;             // how far off a vertex may be
};

std::vector<Stroke> strokes_of(const BorderMap& map, const ContourOptions& options);

}  // namespace keyline
