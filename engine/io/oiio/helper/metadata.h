// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/metadata.h"
#include "engine/io/oiio/helper/library.h"

// Between Keyline's attributes, which are OpenEXR's, and OpenImageIO's.  The few that both know under
// different names are translated: a PNG's DateTime becomes capDate and the other way round.

namespace keyline::oiio {

// Without what describes the storage rather than the picture.
Metadata metadata_of(const OIIO::ImageSpec& spec);

// Formats keep what they have a place for.
void set_metadata(OIIO::ImageSpec& spec, const Metadata& metadata);

}  // namespace keyline::oiio
