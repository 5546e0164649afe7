// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/node/stream.h"

#include "engine/base/channels.h"

#include <algorithm>
#include <fmt/format.h>

namespace keyline {

std::string to_string(const ValueRef& value) { return fmt::format("{}.{}", value.op, value.output); }

std::vector<std::string> Stream::names() const {
    std::vector<std::string> out;
    out.reserve(channels.size());
    for (const StreamChannel& c : channels) out.push_back(c.name);
    return out;
}

const StreamChannel* Stream::find(std::string_view name) const {
    const auto it = std::ranges::find(channels, name, &StreamChannel::name);
    return it == channels.end() ? nullptr : &*it;
}

const StreamChannel* Stream::find_spelled(std::string_view name) const {
    const auto i = keyline::find_spelled(names(), name);
    return i ? &channels[*i] : nullptr;
}

void Stream::set(StreamChannel channel) {
    const auto it = std::ranges::find(channels, channel.name, &StreamChannel::name);
    if (it == channels.end())
        channels.push_back(std::move(channel));
    else
        *it = std::move(channel);
}

Nature Stream::nature_of_colour() const {
    const StreamChannel* red = find_spelled("R");
    return red && find_spelled("G") && find_spelled("B") ? red->nature : Nature{};
}

void Stream::set_nature_of_colour(const Nature& nature) {
    for (const char* name : {"R", "G", "B"})
        if (const StreamChannel* channel = find_spelled(name)) {
            StreamChannel said = *channel;
            said.nature = nature;
            set(std::move(said));
        }
}

}  // namespace keyline
