// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/io/color.h"
#include "engine/node.h"

namespace keyline {

// The stream with its R G B converted, unpremultiplied around the transform where there is an A; all else
// passes.  The metadata loses `chromaticities` and
// `ICCProfile`, which no longer hold.
Stream convert_colour(Builder& builder, const Stream& stream, const ColorTransform& transform);

// The same for every layer that has R G B.
Stream convert_layers(Builder& builder, const Stream& stream, const ColorTransform& transform);

}  // namespace keyline
