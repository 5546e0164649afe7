// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/io/image_source.h"

#include <span>
#include <string>
#include <vector>

// Channels as people read them.

namespace KEYLINE_API keyline {

// A channel under its name in a file, with the type of its samples there: "half", "uint8", …
struct FileChannel {
    std::string name, type;
};

// "R G B A half, ViewLayer.Normal: X Y Z half, ViewLayer.Depth: Z float": in rgba_order(), those of one layer
// and type together.
std::string describe(std::span<const ChannelInfo> channels);
std::string describe(std::span<const FileChannel> channels);

// What of them is of one layer, layer by layer as they first appear.
std::vector<std::vector<FileChannel>> by_layer(std::span<const FileChannel> channels);

}  // namespace keyline
