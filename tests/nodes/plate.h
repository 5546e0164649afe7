// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/support/run.h"

#include <algorithm>
#include <limits>

namespace keyline::testing {

// Channels of one layer of the first frame that the graphs ship with, in this order and without the layer's
// name; fireflies, which would hide every error, are cut at `limit`.
inline Image plate(const std::string& layer, const std::vector<std::string>& names,
                   float limit = std::numeric_limits<float>::max()) {
    const Image file = read_exr(KEYLINE_PLATE);
    Image image(file.window, names);
    image.display = file.display;
    image.metadata = file.metadata;
    for (const std::string& name : names) {
        const Image::Channel& channel = file.channel(layer + "." + name);
        image.channel(name).samples = channel.samples;
        for (float& s : image.channel(name).samples) s = std::min(s, limit);
    }
    return image;
}

}  // namespace keyline::testing
