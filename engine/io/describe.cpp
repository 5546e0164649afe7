// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/describe.h"

#include "engine/base/channels.h"
#include "engine/base/text.h"

#include <fmt/format.h>

namespace keyline {

namespace {

std::vector<ChannelInfo> in_rgba_order(std::span<const ChannelInfo> channels) {
    std::vector<std::string> names;
    for (const ChannelInfo& c : channels) names.push_back(c.name);
    std::vector<ChannelInfo> out;
    for (const std::size_t i : rgba_order(names)) out.push_back(channels[i]);
    return out;
}

}  // namespace

std::string describe(std::span<const ChannelInfo> channels) {
    const std::vector<ChannelInfo> sorted = in_rgba_order(channels);
    std::string out;
    for (std::size_t i = 0; i < sorted.size();) {
        const ChannelName first = split_channel(sorted[i].name);
        const SampleType type = sorted[i].type;
        if (!out.empty()) out += ", ";
        if (!first.layer.empty()) out += escaped(first.layer) + ": ";
        for (; i < sorted.size() && sorted[i].type == type; ++i) {
            const ChannelName name = split_channel(sorted[i].name);
            if (name.layer != first.layer) break;
            out += escaped(name.base) + " ";
        }
        out += sample_type_name(type);
    }
    return out;
}

}  // namespace keyline
