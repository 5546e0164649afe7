// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace keyline {

// The built-in OCIO config, as text, with names and aliases as the ACES configs have them.  Spaces:
// `Linear Rec.709 (sRGB)` (the role scene_linear), `ACEScg`, `ACES2065-1`, `ACEScct`, `ACEScc`,
// `sRGB - Texture`, `Gamma 2.2 Rec.709 - Texture`, `Gamma 2.4 Rec.709 - Texture`, `Raw` (data), and a space
// for each display.  Displays: `sRGB - Display` (the default), `Rec.1886 Rec.709 - Display`,
// `P3-D65 - Display`.  Their views: `ACES 1.0 - SDR Video` (the default), `Un-tone-mapped`, `Raw`.  Named
// transforms: `sRGB - Curve`, `Rec.1886 - Curve`.
extern const char* const kBuiltinColorConfig;

}  // namespace keyline
