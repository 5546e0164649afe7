// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/plate.h"

#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <algorithm>

namespace keyline::bench {

namespace {

// Channels of the layer ViewLayer, by their names without it.
Picture read_channels(const std::string& file, const std::vector<std::string>& in_file,
                      const std::vector<std::string>& names) {
    Imf::InputFile in(file.c_str());
    const auto window = in.header().dataWindow();
    Picture picture(window.max.x - window.min.x + 1, window.max.y - window.min.y + 1, names);
    Imf::FrameBuffer buffer;
    for (std::size_t c = 0; c < names.size(); ++c)
        buffer.insert("ViewLayer." + in_file[c],
                      Imf::Slice::Make(Imf::FLOAT, picture.planes[c].data(), window, sizeof(float),
                                       sizeof(float) * static_cast<std::size_t>(picture.width)));
    in.setFrameBuffer(buffer);
    in.readPixels(window.min.y, window.max.y);
    return picture;
}

}  // namespace

Picture read_beauty(const std::string& file) {
    return read_channels(file, {"Combined.R", "Combined.G", "Combined.B", "Combined.A"},
                         {"R", "G", "B", "A"});
}

Picture read_passes(const std::string& file) {
    const std::vector<std::string> names{"CryptoObject00.r", "CryptoObject00.g", "CryptoObject00.b",
                                         "CryptoObject00.a", "Depth.Z",          "Normal.X",
                                         "Normal.Y",         "Normal.Z"};
    return read_channels(file, names, names);
}

Picture grey_of(const Picture& beauty) {
    Picture grey(beauty.width, beauty.height, {"Y"});
    for (std::size_t i = 0; i < grey.planes[0].size(); ++i)
        grey.planes[0][i] = std::clamp(
            0.2126F * beauty.planes[0][i] + 0.7152F * beauty.planes[1][i] + 0.0722F * beauty.planes[2][i],
            0.0F, 1.0F);
    return grey;
}

Picture mask_of(const Picture& grey, float level) {
    Picture mask = grey;
    for (float& v : mask.planes[0]) v = v > level ? 1.0F : 0.0F;
    return mask;
}

}  // namespace keyline::bench
