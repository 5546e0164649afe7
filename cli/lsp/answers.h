// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cli/lsp/analysis.h"
#include "cli/lsp/document.h"
#include "cli/lsp/mentions.h"

#include <string>

// The protocol's results, a value of JSON each: a file for every kind of question.

namespace keyline::lsp {

// What is known of a text when a question comes.
struct Known {
    const Document& document;
    const Analysis& analysis;
    Session& session;
};

// diagnostics.cpp
std::string diagnostics(const Known& known);

// Where in the text an error is: the token at its place; for one in another file, where that is used.
Span span_of(const Document& document, const Error& error);

// completion.cpp
std::string completions(const Known& known, std::size_t byte);

// hover.cpp; "null" where there is nothing to say.
std::string hover(const Known& known, std::size_t byte);

// navigation.cpp
std::string definition(const Known& known, std::size_t byte);
std::string references(const Known& known, std::size_t byte);
std::string renamed(const Known& known, std::size_t byte,
                    const std::string& name);  // throws Failure (kGraph)
std::string rename_range(const Known& known, std::size_t byte);

// outline.cpp
std::string symbols(const Known& known);
std::string formatted(const Known& known);

// colors.cpp
std::string colors(const Known& known);
std::string color_presentations(const Known& known, const Value& color, Span at);

// actions.cpp; of the errors whose places a range touches.
std::string actions(const Known& known, Span range);

}  // namespace keyline::lsp
