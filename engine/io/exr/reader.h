// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/io/image_source.h"

#include <filesystem>
#include <memory>

namespace keyline::exr {

// Opens an OpenEXR file: one group a part that is taken.  Scanline and tiled parts (the full-resolution
// level), every compression.  Luminance/chroma images (Y RY BY) come as R G B, as OpenEXR's own RGBA
// interface gives them; a channel that is subsampled otherwise comes at full resolution, each sample
// repeated.  Samples keep their type.
//
// Throws Failure (kInput), also where the header declares more samples than a file of this size can hold.
std::unique_ptr<FileSource> open_exr(const std::filesystem::path& file, const OpenOptions& options);

}  // namespace keyline::exr
