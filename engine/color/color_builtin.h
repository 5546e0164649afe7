// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace keyline {

// The built-in OCIO config, as text.  Spaces: `Linear Rec.709 (sRGB)` (the role scene_linear), `ACEScg`,
// `ACES2065-1`, `sRGB - Texture`, `Raw` (data), and `sRGB - Display`, the display's own.  Views of that
// display: `ACES 1.0 - SDR Video` (the default), `Un-tone-mapped`, `Raw`.
extern const char* const kBuiltinColorConfig;

}  // namespace keyline
