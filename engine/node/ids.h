// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/node/node.h"

// What nodes do with ids, which are only ever compared: those that compute with every channel let them pass
// and say so; those that take one for a number say that.

namespace KEYLINE_API keyline {

// Warns of the exact channels of a stream that a node computes with; `instead` says what becomes of them.
void tell_of_ids(Builder& builder, const Stream& stream, const char* instead = "they pass as they are");

// The sample as a number: of an integer's bits the float nearest to it.
ValueRef as_number(Builder& builder, const StreamChannel& channel, const Rect& window);

// The stream's channels that a port takes, in its order, as numbers.  Throws Failure (kGraph) that says what
// is missing and which layers have it, or that ids are no colour; warns of ids that are taken for numbers.
std::vector<ValueRef> take_channels(Builder& builder, const Stream& stream, const Takes& takes);

}  // namespace keyline
