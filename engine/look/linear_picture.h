// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/io/image_source.h"
#include "engine/look/flip.h"

#include <string>

namespace KEYLINE_API keyline {

// How the samples of a picture stand for light.
enum class Encoding { kLinear, kSrgb };

// R G B over a window, of a layer where one is named; black where the source has nothing, NaN and negative
// light too.  Throws Failure (kGraph) where it has no R G B.
LinearPicture linear_picture(const ImageSource& source, const std::string& layer, const Rect& window,
                             Encoding encoding);

}  // namespace keyline
