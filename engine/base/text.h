// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"

#include <cstddef>
#include <string>
#include <string_view>

// Text that others wrote (names in files, what libraries say) where it is shown or put into JSON or XML.

namespace KEYLINE_API keyline {

// Length in bytes of the well-formed UTF-8 sequence that `text` starts with; 0 where it starts with none.
std::size_t utf8_length(std::string_view text);

enum class Escapes {
    kShown,  // "\n", "\t", "\x1b", "\u202e"; bytes that are no text as "\xe9"
    kJson,   // those of JSON; bytes that are no text become U+FFFD
};

// The text on one line of valid UTF-8: control characters, line separators, characters that change the
// direction of what follows and bytes that are not UTF-8 are escaped, as a terminal may obey them.  What is
// escaped already stays as it is, unless it is for JSON.
std::string escaped(std::string_view text, Escapes escapes = Escapes::kShown);

// For XML, as text and in attributes.  What no XML may hold is shown as escapes are.
std::string for_xml(std::string_view text);

}  // namespace keyline
