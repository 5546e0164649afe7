// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/io/image_sink.h"

#include <filesystem>
#include <memory>

namespace keyline::oiio {

// Starts a picture that OpenImageIO writes.  It holds the display window; the format's pixel (0, 0) is that
// window's corner.  Integers are value × maximum + ½, cut to whole numbers, of values limited to 0…1; NaN is
// 0.  Where the format says that alpha is unassociated, colour is divided by it, in float, where it is above
// 0.  A single channel of any name is stored as grey.
//
// Throws Failure: kGraph where the format can't hold the channels, the depth or the compression, kOutput
// where the file can't be made.
std::unique_ptr<ImageSink> create_picture(const std::filesystem::path& file, const SinkSpec& spec);

}  // namespace keyline::oiio
