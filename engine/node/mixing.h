// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/node/node.h"
#include "engine/params/params.h"

// How much of what a node changes takes effect, and where: one mechanism for all nodes that change colour.

namespace KEYLINE_API keyline {

// Base of the Params of a node with `mix` and `mask`, declared by declare_mixed().  The adaptor then mixes
// what the node makes with what its leading input was; the node's own code knows nothing of it.
struct Mixed {
    double mix = 1;
    std::optional<Input> mask;
};

// The node's own fields, then `mix` and `mask`.
template <class... Fields>
constexpr auto declare_mixed(Fields... own) {
    return declare(
        own..., field(&Mixed::mix, "mix", "How much of the change there is.", between(0, 1)),
        input(&Mixed::mask, "mask", "Where there is a change; nowhere outside its data window.", matte()));
}

// `after` where mix × mask is 1, `before` where it is 0, between them before (1 − k) + after k: every channel
// of `after`, and those that only `before` has.  The window is the union; display window and metadata come
// from `after`.  A channel that one of them does not have is 0 there, an A opaque (see with_alpha).
Stream mix_back(Builder& builder, const Stream& before, const Stream& after, const Mixed& mixed);

// The stream with an A: colour without one is opaque inside its data window.
Stream with_alpha(Builder& builder, Stream stream);

}  // namespace keyline
