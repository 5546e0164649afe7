// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/io/image_source.h"

#include <cstdint>
#include <string>
#include <vector>

namespace KEYLINE_API keyline {

// What the samples of one channel are, inside its data window.
struct ChannelStatistics {
    std::string channel;  // as it is handed on by the source
    int64_t samples = 0, nan = 0, infinite = 0, negative = 0;
    double least = 0, largest = 0, sum = 0;  // of the finite ones

    int64_t finite() const { return samples - nan - infinite; }
    double mean() const { return finite() > 0 ? sum / static_cast<double>(finite()) : 0; }
    void add(double sample);
};

// Of every channel, in the file's order.  Throws Failure (kInput) for what is damaged.
std::vector<ChannelStatistics> statistics_of(const ImageSource& source);

}  // namespace keyline
