// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/error.h"

#include <string>

namespace keyline::cli {

// How messages look where a person reads them.  What reads files and pipes finds one line a message.
struct MessageStyle {
    bool excerpts = false;  // the line of the file that a message is about
    bool colours = false;
};

// Of standard error.  NO_COLOR in the environment keeps colours away, and so does a TERM that has none.
MessageStyle message_style();

// Error::text() or warning_text(), and what the style adds: the code, colour to a word of the first line,
// lines below it. Each line but the last ends with a line feed.
std::string styled_error(const Error& error, const MessageStyle& style);
std::string styled_warning(const Error& warning, const MessageStyle& style);

}  // namespace keyline::cli
