// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/json/value.h"

#include <string>
#include <string_view>

namespace KEYLINE_API keyline {

// JSON text to values with places: line and column from 1, columns in code points; a value's place is its
// first character, a key's its opening quote.  A line ends at LF, CR LF or a lone CR.  A byte order mark at
// the start and // and /* */ comments are allowed.  Throws Failure (kGraph) with the place for text that is
// not JSON, invalid UTF-8, a number beyond double's range, a key given twice in one object, and nesting
// beyond depth 64.
Value parse_json(std::string_view text, const std::string& file);

// A value from the command line: JSON (without comments) where it is JSON, else the text as a string.  Every
// place in it is `option`, as typed ("--set smooth.sigma=-3").  Unless it is a string, the value's `text` is
// what was typed.  Throws Failure (kGraph) for JSON that can't be taken: a key given twice, nesting beyond
// depth 64, a number beyond double's range.
Value parse_option_value(std::string_view text, const std::string& option);

}  // namespace keyline
