// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/look/differences.h"

#include <filesystem>

namespace KEYLINE_API keyline {

// Writes a map as a picture, 0 black and `most` nearly white; the format follows the extension.  Throws
// Failure as create_image() does.
void write_heat_map(const std::filesystem::path& file, const ErrorMap& map, float most);

}  // namespace keyline
