// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"

#include <string>
#include <string_view>

namespace KEYLINE_API keyline {

// JSON text in the layout of graph files, as graphs/ has it.  Where lines end is the author's choice, but for
// what is too long, and for `nodes`, which have lines of their own; blanks and alignment are not.  Comments
// and blank lines stay.  The same again comes out as it is.
//
// - Two blanks a level.  What begins on the line of its bracket goes on below its first item.
// - { "key": value } and [1, 2]: blanks inside of braces, none inside of brackets.
// - Objects on lines of their own, one below the other without a blank line, begin in one column.
// - Lines are 120 characters long at most, where something can be broken.
//
// Throws Failure (kGraph), as parse_json() does, for text that is not JSON; `name` stands for the file.
std::string json_layout(std::string_view text, const std::string& name);

}  // namespace keyline
