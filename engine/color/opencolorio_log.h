// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"

#include <string>

namespace KEYLINE_API keyline {

// Gives each thing that OpenColorIO has to say of a config, once, to `hear`, in one line; it would print them
// to standard error.  Called on any thread.
void hear_opencolorio(void (*hear)(const std::string& message));

}  // namespace keyline
