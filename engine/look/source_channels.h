// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/io/image_source.h"
#include "engine/node/stream.h"

#include <cstddef>
#include <vector>

namespace keyline {

// The channels of all groups of a source in turn, and what they hold.
struct SourceChannels {
    struct Place {
        std::size_t group = 0, channel = 0;
    };
    explicit SourceChannels(const ImageSource& source);

    const Place& place(ValueRef value) const;
    SampleType type(ValueRef value) const;

    Stream stream;  // its values name channels by their number, as the output of no operation
    std::vector<SampleType> types;
    std::vector<Place> places;
};

}  // namespace keyline
