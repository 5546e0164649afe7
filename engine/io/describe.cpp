// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/describe.h"

#include "engine/base/channels.h"
#include "engine/base/text.h"

#include <algorithm>

namespace keyline {

namespace {

std::vector<FileChannel> in_rgba_order(std::span<const FileChannel> channels) {
    std::vector<std::string> names;
    for (const FileChannel& c : channels) names.push_back(c.name);
    std::vector<FileChannel> out;
    for (const std::size_t i : rgba_order(names)) out.push_back(channels[i]);
    return out;
}

}  // namespace

std::string describe(std::span<const FileChannel> channels) {
    const std::vector<FileChannel> sorted = in_rgba_order(channels);
    std::string out;
    for (std::size_t i = 0; i < sorted.size();) {
        const ChannelName first = split_channel(sorted[i].name);
        const std::string& type = sorted[i].type;
        if (!out.empty()) out += ", ";
        if (!first.layer.empty()) out += escaped(first.layer) + ": ";
        for (; i < sorted.size() && sorted[i].type == type; ++i) {
            const ChannelName name = split_channel(sorted[i].name);
            if (name.layer != first.layer) break;
            out += escaped(name.base) + " ";
        }
        out += type;
    }
    return out;
}

std::string describe(std::span<const ChannelInfo> channels) {
    std::vector<FileChannel> typed;
    for (const ChannelInfo& c : channels) typed.push_back({c.name, sample_type_name(c.type)});
    return describe(typed);
}

std::vector<std::vector<FileChannel>> by_layer(std::span<const FileChannel> channels) {
    std::vector<std::vector<FileChannel>> out;
    for (const FileChannel& c : channels) {
        const std::string_view layer = split_channel(c.name).layer;
        const auto same = std::ranges::find_if(
            out, [&](const auto& group) { return split_channel(group.front().name).layer == layer; });
        if (same == out.end())
            out.push_back({c});
        else
            same->push_back(c);
    }
    return out;
}

}  // namespace keyline
