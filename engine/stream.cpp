// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/stream.h"

#include <algorithm>

namespace keyline {

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

void Stream::set(const std::string& name, ValueRef value) {
    const auto it = std::ranges::find(channels, name, &StreamChannel::name);
    if (it == channels.end())
        channels.push_back({name, value});
    else
        it->value = value;
}

}  // namespace keyline
