// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/value.h"

#include <string>
#include <string_view>

namespace keyline {

// JSON text to values with places: line and column from 1, columns in code points.  // and /* */ comments are
// allowed.  Throws Failure (kGraph) with the place for text that is not JSON, invalid UTF-8, a key given
// twice in one object, and nesting beyond depth 64.
Value parse_json(std::string_view text, const std::string& file);

// A value from the command line: JSON where it is JSON, else the text as a string.  Every place in it is
// `option`, as typed ("--set smooth.sigma=-3").
Value parse_option_value(std::string_view text, const std::string& option);

}  // namespace keyline
