// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/color/color.h"
#include "engine/node/node.h"

namespace KEYLINE_API keyline {

// Of the parameter that nodes of colour have in common.
inline constexpr const char* kContextHelp =
    "Variables of the config's context, by name: { \"SHOT\": \"sh010\" } is what $SHOT means in its files.";

// The stream with its R G B converted, unpremultiplied around the transform where there is an A; all else
// passes.  The metadata loses `chromaticities` and
// `ICCProfile`, which no longer hold.
Stream convert_colour(Builder& builder, const Stream& stream, const ColorTransform& transform);

// The same for every layer that holds colour in R G B, however they are spelled; no ids, and no measures such
// as normals.
Stream convert_layers(Builder& builder, const Stream& stream, const ColorTransform& transform);

}  // namespace keyline
