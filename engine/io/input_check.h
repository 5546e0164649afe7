// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/geometry.h"

#include <filesystem>

namespace keyline {

// Throws Failure (kInput) where an image that opens is known not to have all of a region, because it is still
// being written or was cut off: of OpenEXR files, whose tables of chunks tell.
void check_finished(const std::filesystem::path& file, const Rect& region);

// Whether nobody seems to be writing an image any more: its structure is whole, as far as it can be followed,
// or nothing was written to it for some seconds.
bool is_at_rest(const std::filesystem::path& file);

}  // namespace keyline
