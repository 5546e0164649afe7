// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// Channels by name, as OpenEXR names them: the layer is what stands before the last dot.  All functions are
// pure, take names that differ from each other, and answer with indices into them; what is not there is a
// Failure (kGraph) that says what is.  The caller adds place and node.

namespace KEYLINE_API keyline {

struct ChannelName {
    std::string_view layer;  // empty for a channel without one
    std::string_view base;
};

ChannelName split_channel(std::string_view name);

// "layer.base", or just the base without a layer.
std::string join_channel(std::string_view layer, std::string_view base);

// The component that a channel's last name spells, as "R" for R, r and red, in any case; empty for a name
// that is none of R G B A X Y Z.
std::string_view component_of(std::string_view base);

// The channel of this name, or else one of the same layer that spells the same component in another way.
std::optional<std::size_t> find_spelled(std::span<const std::string> names, std::string_view name);

// Whether a layer's or channel's name is `wanted`, or ends in it from a dot on.
bool is_called(std::string_view name, std::string_view wanted);

// "CryptoObject" and 1 of "CryptoObject01": the levels of a Cryptomatte are layers that differ in their last
// two digits.
struct LevelName {
    std::string_view name;
    int number = 0;
};
std::optional<LevelName> level_of(std::string_view layer);

// The layers, in the order in which they first appear; without the empty one.
std::vector<std::string> layers_of(std::span<const std::string> names);

struct Picked {
    std::size_t index;
    std::string name;  // what the channel is called from here on

    friend bool operator==(const Picked&, const Picked&) = default;
};

// What `id:SELECTION` takes, in the order of `names`.  SELECTION is tried as a full layer, a full channel,
// the end of a layer from a dot on, the end of a channel from a dot on, and a channel in another spelling;
// the first rule with a match decides, and several layers or channels under it are a failure.  A layer's
// channels lose the layer's name, a single channel keeps its last component.  "NAME." takes every layer below
// NAME without that prefix, "." the channels that have no layer.
std::vector<Picked> select_channels(std::span<const std::string> names, std::string_view selection);

// As listed(), but bounded: some files have hundreds of channels.
std::string some_of(const std::vector<std::string>& words);

struct ColourChannels {
    std::size_t r, g, b;
    std::optional<std::size_t> a;

    friend bool operator==(const ColourChannels&, const ColourChannels&) = default;
};

// R G B, and A where there is one, however they are spelled.
ColourChannels find_colour(std::span<const std::string> names);

// The only channel, or A, however it is spelled.
std::size_t find_matte(std::span<const std::string> names);

// The channels of these names, however they are spelled, in the order of `wanted`.  R G B serve where X Y Z
// are wanted and not there.
std::vector<std::size_t> find_channels(std::span<const std::string> names,
                                       std::span<const std::string> wanted);

// All channels in the order in which people and picture formats expect them: those without a layer, then the
// layers as they first appear; within each R G B A before the rest, which keeps its order.
std::vector<std::size_t> rgba_order(std::span<const std::string> names);

}  // namespace keyline
