// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace keyline {

struct LibraryVersion {
    std::string name, version;
};

std::string keyline_version();

// OpenEXR and OpenColorIO as they run, the others as they were built with.  OpenImageIO is among them where
// the module for other formats is there; it is not loaded for this.
std::vector<LibraryVersion> library_versions();

}  // namespace keyline
