// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/io/image_source.h"

#include <filesystem>
#include <memory>

namespace keyline::oiio {

// Opens a picture with OpenImageIO.  Samples of integers become value / maximum, as the nearest float; half
// and float stay what they are.  Colour that the file has not multiplied by its alpha is multiplied here, in
// float; nothing else about it is changed, whatever the file says about its colour space.
//
// A file of several pictures (pages, frames, layers) gives its first; `part` names another, by number or
// name. Throws Failure (kInput) as open_image() does.
std::unique_ptr<FileSource> open_picture(const std::filesystem::path& file, const OpenOptions& options);

}  // namespace keyline::oiio
