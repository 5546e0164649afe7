// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/expr/expression.h"

namespace keyline {

// From weak to strong: ?:, or, and, not, comparisons, + −, * / %, the sign, ^.  Throws ExpressionFault.
Term parse_expression(std::string_view text);

}  // namespace keyline
