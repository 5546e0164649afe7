// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/look/linear_picture.h"

#include "engine/base/channels.h"
#include "engine/look/region.h"
#include "engine/look/source_channels.h"
#include "engine/simd/elementary.h"

#include <algorithm>
#include <array>

namespace keyline {

namespace {

double light_of(double sample, Encoding encoding) {
    const double v = sample > 0 ? std::min(sample, 1.0) : 0;
    if (encoding == Encoding::kLinear) return v;
    return v <= 0.04045 ? v / 12.92 : elementary::pow((v + 0.055) / 1.055, 2.4);
}

// The numbers of R, G and B.
std::array<std::size_t, 3> colour_of(const std::vector<std::string>& names, const std::string& layer) {
    if (layer.empty()) {
        const ColourChannels c = find_colour(names);
        return {c.r, c.g, c.b};
    }
    const std::vector<Picked> picked = select_channels(names, layer);
    std::vector<std::string> inside;
    for (const Picked& p : picked) inside.push_back(p.name);
    const ColourChannels c = find_colour(inside);
    return {picked[c.r].index, picked[c.g].index, picked[c.b].index};
}

}  // namespace

LinearPicture linear_picture(const ImageSource& source, const std::string& layer, const Rect& window,
                             Encoding encoding) {
    const std::vector<std::string> names = SourceChannels(source).stream.names();
    const std::array<std::size_t, 3> colour = colour_of(names, layer);
    LinearPicture out{window.width(), window.height(), {}};
    for (const Rect& strip : strips_of(window, names.size())) {
        const auto samples = read_region(source, strip);
        for (std::size_t c = 0; c < 3; ++c)
            for (const double sample : samples[colour[c]])
                out.rgb[c].push_back(static_cast<float>(light_of(sample, encoding)));
    }
    return out;
}

}  // namespace keyline
