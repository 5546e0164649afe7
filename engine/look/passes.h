// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/io/image_source.h"

#include <string>

namespace KEYLINE_API keyline {

// The passes of a render by what renderers call them: Arnold, Cycles, Karma, RenderMan, Redshift and V-Ray.
// Each as what stands behind the colon of an input, "Combined" or "." for the channels without a layer; empty
// where the file has none.
struct RenderPasses {
    std::string beauty;
    bool has_alpha = false;  // the beauty
    std::string albedo;      // the colour of surfaces
    std::string light;       // what arrives there directly
    bool is_raw = false;     // the light; otherwise the albedo is multiplied into it
    std::string normal;
    std::string depth;               // a single channel
    std::string objects, materials;  // Cryptomattes
};

RenderPasses find_passes(const ImageSource& source);

}  // namespace keyline
