// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"

#include <filesystem>
#include <string>

namespace KEYLINE_API keyline {

// A whole file; "-" is standard input.  Throws Failure where it can't be read; `what` it is called in it.
std::string read_text(const std::filesystem::path& file, const std::string& what);

}  // namespace keyline
