// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/look/passes.h"

namespace KEYLINE_API keyline {

// Numbers of a render that a drawing of it starts with.  Of a large picture a part of the rows is looked at.
struct RenderLevels {
    double light = 0;       // what parts light from shade: of the light pass without the colour of surfaces
    double distance = 0;    // the median depth of what is seen; 0 without depth
    double colourless = 0;  // the share of what is seen that has no albedo: metal, glass, what glows
    double slope = 0;       // of the beauty's grey, as eyes see it: what nine in ten pixels have less than
};

// Throws Failure (kInput) for what is damaged.
RenderLevels levels_of(const ImageSource& source, const RenderPasses& passes);

}  // namespace keyline
