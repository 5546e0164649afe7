// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/describe.h"

#include "engine/channels.h"

#include <fmt/format.h>

namespace keyline {

std::string describe(const Rect& rect) {
    if (rect.empty()) return "empty";
    return fmt::format("{} × {} at ({}, {})", rect.width(), rect.height(), rect.x0, rect.y0);
}

std::string describe(std::span<const ChannelInfo> channels) {
    std::string out;
    for (std::size_t i = 0; i < channels.size();) {
        const ChannelName first = split_channel(channels[i].name);
        const SampleType type = channels[i].type;
        if (!out.empty()) out += ", ";
        if (!first.layer.empty()) out += fmt::format("{}: ", first.layer);
        for (; i < channels.size() && channels[i].type == type; ++i) {
            const ChannelName name = split_channel(channels[i].name);
            if (name.layer != first.layer) break;
            out += fmt::format("{} ", name.base);
        }
        out += sample_type_name(type);
    }
    return out;
}

}  // namespace keyline
