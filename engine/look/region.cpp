// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/look/region.h"

#include "engine/look/scan.h"

#include <algorithm>

namespace keyline {

namespace {

constexpr std::size_t kStripSamples = std::size_t{1} << 23;
constexpr std::size_t kFewestRows = 16;  // a strip cuts chunks, which are decoded for both of its sides

}  // namespace

std::vector<std::vector<double>> read_region(const ImageSource& source, const Rect& region) {
    std::vector<std::vector<double>> out;
    std::vector<double> row;
    const std::ptrdiff_t width = region.width();
    for (std::size_t g = 0; g < source.header().groups.size(); ++g) {
        const std::size_t channels = source.header().groups[g].channels.size(), first = out.size();
        out.resize(first + channels, std::vector<double>(static_cast<std::size_t>(region.area())));
        scan(source, g, std::vector<bool>(channels, true), region, [&](const ScannedChunk& chunk) {
            for (std::size_t c = 0; c < channels; ++c)
                for (int y = chunk.rect.y0; y < chunk.rect.y1; ++y)
                    std::ranges::copy(
                        row_of(chunk.planes[c], y, row),
                        out[first + c].begin() + (y - region.y0) * width + chunk.rect.x0 - region.x0);
        });
    }
    return out;
}

std::vector<Rect> strips_of(const Rect& window, std::size_t channels) {
    const std::size_t row = std::max<std::size_t>(1, channels * static_cast<std::size_t>(window.width()));
    const auto height =
        static_cast<int>(std::clamp<std::size_t>(kStripSamples / row, kFewestRows, 1U << 20U));
    std::vector<Rect> out;
    for (int y = window.y0; y < window.y1; y += height)
        out.push_back({window.x0, y, window.x1, std::min(window.y1, y + height)});
    return out;
}

}  // namespace keyline
