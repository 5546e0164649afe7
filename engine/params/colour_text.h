// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/params/param_types.h"

#include <optional>
#include <string_view>

namespace keyline {

// The scene-linear colour of an sRGB "#rrggbb"; nothing for other text.
std::optional<Color> colour_of_text(std::string_view text);

}  // namespace keyline
