// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/io/image_source.h"

#include <span>
#include <string>

// Channels as people read them.

namespace KEYLINE_API keyline {

// "R G B A half, ViewLayer.Normal: X Y Z half, ViewLayer.Depth: Z float": in rgba_order(), those of one layer
// and type together.
std::string describe(std::span<const ChannelInfo> channels);

}  // namespace keyline
