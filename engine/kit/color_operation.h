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

// What colour is meant for before a conversion and behind it.
struct Conversion {
    Nature::For from = Nature::For::kUnknown, to = Nature::For::kUnknown;
};

// What colour in a space of the config is meant for.
Nature::For colour_for(const ColorConfig& colors, const std::string& space);

// The stream with its R G B converted, unpremultiplied around the transform where there is an A; all else
// passes.  The metadata loses `chromaticities` and `ICCProfile`, which no longer hold.  Warns where what is
// known of the stream says that it should not be converted so.
Stream convert_colour(Builder& builder, const Stream& stream, const ColorTransform& transform,
                      const Conversion& conversion = {});

// The same for every layer that holds colour in R G B, however they are spelled; no ids, and no measures such
// as normals.
Stream convert_layers(Builder& builder, const Stream& stream, const ColorTransform& transform,
                      const Conversion& conversion);

}  // namespace keyline
