// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/node/node_adaptor.h"

// Places on surfaces: the pass that tells each pixel where on its object it is.

namespace KEYLINE_API keyline {

// The input with just the channels that are coordinates, by name, as layers hold others too, and in any
// order: U V, S T, X Y Z, or R G B where the file says that they are no colour.  Without any, the parameter's
// error says which there are.
Stream surface_places(Builder& builder, const Input& input, const char* parameter);

}  // namespace keyline
