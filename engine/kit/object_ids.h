// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/kit/cryptomatte.h"

#include <optional>
#include <string_view>
#include <vector>

// What nodes between objects take: a Cryptomatte or one channel of ids, and the depth.

namespace KEYLINE_API keyline {

struct ObjectIds {
    std::optional<Cryptomatte> crypto;  // else `values` is one channel of ids
    bool integers = false;              // which are unsigned integers
    std::vector<ValueRef> values;       // ids and coverage in turn, or the channel
};

// A stream of one channel is ids, another has a Cryptomatte called `layer`, as find_cryptomatte() has it; the
// parameter of that name is told of what is wrong with it.
ObjectIds find_object_ids(Builder& builder, const Stream& stream, std::string_view layer);

// An input called "depth"; a position is none.
Link link_depth(Builder& builder, const Input& depth);

}  // namespace keyline
