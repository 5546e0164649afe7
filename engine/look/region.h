// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/io/image_source.h"

#include <cstddef>
#include <vector>

namespace keyline {

// All channels of a source over a region, group after group; 0 outside of data windows.
std::vector<std::vector<double>> read_region(const ImageSource& source, const Rect& region);

// A window in pieces of whole rows, each of which takes some 60 MB as so many channels.
std::vector<Rect> strips_of(const Rect& window, std::size_t channels);

}  // namespace keyline
