// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/io/image_source.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace keyline::oiio {

class PictureSource : public FileSource {
public:
    // Of the channels in the file: "uint8", "half", …
    const std::vector<std::string>& stored_types() const { return stored_types_; }

protected:
    std::vector<std::string> stored_types_;
};

// Opens a picture with OpenImageIO.  Samples of integers become value / maximum, as the nearest float; half
// and float stay what they are.  Colour that the file has not multiplied by its alpha is multiplied here, in
// float; nothing else about it is changed, whatever the file says about its colour space.
//
// A file of several pictures (pages, frames, layers) gives its first; `part` names another, by number or
// name. Throws Failure (kInput) as open_image() does.
std::unique_ptr<PictureSource> open_picture(const std::filesystem::path& file, const OpenOptions& options);

}  // namespace keyline::oiio
