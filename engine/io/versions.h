// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"

#include <string>
#include <vector>

namespace KEYLINE_API keyline {

struct LibraryVersion {
    std::string name, version;
};

std::string keyline_version();

// OpenEXR and OpenColorIO as they run, the others as they were built with.  OpenImageIO is among them where
// the helper for other formats is there; it is not started for this.
std::vector<LibraryVersion> library_versions();

}  // namespace keyline
