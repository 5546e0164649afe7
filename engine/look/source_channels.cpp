// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/look/source_channels.h"

#include "engine/base/index.h"

namespace keyline {

SourceChannels::SourceChannels(const ImageSource& source) {
    const ImageHeader& header = source.header();
    stream.metadata = std::make_shared<Metadata>(header.metadata);
    stream.file = header.file;
    for (std::size_t g = 0; g < header.groups.size(); ++g)
        for (std::size_t c = 0; c < header.groups[g].channels.size(); ++c) {
            const ChannelInfo& info = header.groups[g].channels[c];
            stream.channels.push_back({info.name, {-1, static_cast<int>(places.size())}});
            types.push_back(info.type);
            places.push_back({g, c});
        }
    learn_channels(stream, types);
}

const SourceChannels::Place& SourceChannels::place(ValueRef value) const {
    return places[index(value.output)];
}

SampleType SourceChannels::type(ValueRef value) const { return types[index(value.output)]; }

}  // namespace keyline
