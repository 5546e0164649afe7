// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/params/file_name.h"

#include <string>

namespace KEYLINE_API keyline {

// What to say where the file of a frame is not there: which frames are on disk; else a file of the folder
// that has nearly its name, if there is one.  Throws Failure (kInput) for a folder that can't be listed.
std::string hint_for_missing(const FileName& file, int frame);

}  // namespace keyline
