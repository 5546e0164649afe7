// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/digest.h"

#include <filesystem>

namespace keyline {

// A file as it is now: its name, however it is spelled, its size, when it was last written, and which file of
// the file system has the name.  Unknown where there is no such file.  What is the same by this is taken to
// hold the same bytes.
Digest file_identity(const std::filesystem::path& file);

// Of a file's bytes, wherever it lies.  Throws Failure (kInput) where they can't be read.
Digest file_content(const std::filesystem::path& file);

}  // namespace keyline
