// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/look/statistics.h"

#include "engine/look/scan.h"

#include <algorithm>
#include <cmath>

namespace keyline {

void ChannelStatistics::add(double sample) {
    const bool first = finite() == 0;
    ++samples;
    if (std::isnan(sample)) {
        ++nan;
        return;
    }
    if (sample < 0) ++negative;
    if (std::isinf(sample)) {
        ++infinite;
        return;
    }
    least = first ? sample : std::min(least, sample);
    largest = first ? sample : std::max(largest, sample);
    sum += sample;
}

std::vector<ChannelStatistics> statistics_of(const ImageSource& source) {
    std::vector<ChannelStatistics> out;
    std::vector<double> buffer;
    for (std::size_t group = 0; group < source.header().groups.size(); ++group) {
        const ChannelGroup& g = source.header().groups[group];
        const std::size_t first = out.size();
        for (const ChannelInfo& c : g.channels) out.emplace_back().channel = c.name;
        const std::vector<bool> all(g.channels.size(), true);
        scan(source, group, all, g.window, [&](const ScannedChunk& chunk) {
            for (std::size_t c = 0; c < chunk.planes.size(); ++c)
                for (int y = chunk.rect.y0; y < chunk.rect.y1; ++y)
                    for (const double sample : row_of(chunk.planes[c], y, buffer)) out[first + c].add(sample);
        });
    }
    return out;
}

}  // namespace keyline
