// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/measure/accuracy.h"

#include <vector>

namespace keyline {

Offsets offsets_of(const std::vector<double>& offs);

}  // namespace keyline
