// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"

#include <cstddef>

namespace KEYLINE_API keyline {

// An int that is known not to be negative, as what containers are indexed by.
constexpr std::size_t index(int i) { return static_cast<std::size_t>(i); }

}  // namespace keyline
