// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/base/metadata.h"

namespace KEYLINE_API keyline {

// Width over height of a pixel, from an image's attributes; 1 where they do not say.
float pixel_aspect(const Metadata& metadata);
void set_pixel_aspect(Metadata& metadata, double aspect);

}  // namespace keyline
