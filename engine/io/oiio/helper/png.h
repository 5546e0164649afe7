// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace keyline::oiio {

enum class PngPart {
    kHeader,  // up to the pixels
    kWhole,
};

// Throws Failure (kInput) for a PNG file that ends early or whose checksums are wrong.  libpng would find
// both too, but prints them to standard error behind our back, and OpenImageIO gives no way to stop it.
void check_png(const std::filesystem::path& file, PngPart part);

}  // namespace keyline::oiio
