// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"

#include <string_view>

namespace KEYLINE_API keyline {

// Whether the whole of a name matches a pattern in which * stands for any characters and \* for itself.
bool matches(std::string_view name, std::string_view pattern);

}  // namespace keyline
