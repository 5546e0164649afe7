// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/params/param_types.h"

namespace KEYLINE_API keyline {

// Whether "= EXPRESSION" may stand for a value of a type: a number, a truth, a word, a list.  Elsewhere it is
// text.
bool takes_expressions(const TypeInfo& type);

// Whether { "keys": … } may: for whatever takes expressions, for text and for files.
bool takes_keys(const TypeInfo& type);

}  // namespace keyline
