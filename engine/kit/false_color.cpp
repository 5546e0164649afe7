// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/false_color.h"

#include <algorithm>
#include <cstddef>

namespace keyline {

std::array<float, 3> heat(float number) {
    using Color = std::array<float, 3>;
    static constexpr std::array<Color, 6> kStops{{{0, 0, 0},
                                                  {0.26F, 0.06F, 0.42F},
                                                  {0.66F, 0.16F, 0.40F},
                                                  {0.93F, 0.36F, 0.22F},
                                                  {0.99F, 0.69F, 0.20F},
                                                  {1, 1, 0.78F}}};
    const float at = std::clamp(number, 0.0F, 1.0F) * static_cast<float>(kStops.size() - 1);
    const auto below = std::min(static_cast<std::size_t>(at), kStops.size() - 2);
    const float share = at - static_cast<float>(below);
    Color out;
    for (std::size_t c = 0; c < 3; ++c)
        out[c] = kStops[below][c] + share * (kStops[below + 1][c] - kStops[below][c]);
    return out;
}

std::array<float, 3> colour_of_id(uint32_t id) {
    if (id == 0) return {};
    uint32_t hash = id * 0x9e3779b1U;  // neighbours in number are no neighbours in colour
    hash = (hash ^ hash >> 15U) * 0x85ebca6bU;
    hash ^= hash >> 13U;
    std::array<float, 3> out;
    for (std::size_t c = 0; c < 3; ++c)
        out[c] = 0.25F + 0.7F * static_cast<float>(hash >> (8 * c) & 255U) / 255;
    return out;
}

}  // namespace keyline
