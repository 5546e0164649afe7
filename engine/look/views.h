// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/io/describe_image.h"
#include "engine/io/image_source.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace KEYLINE_API keyline {

// One part of an image in one view, open to be read.
struct PartView {
    std::string part, view;  // empty where the file has only one
    std::shared_ptr<const ImageSource> source;
};

// All that can be read of a file: every part of every view.  What can't, a deep part, is told.
std::vector<PartView> open_views(const std::filesystem::path& file, const ImageDescription& image,
                                 Diagnostics& diagnostics);

}  // namespace keyline
