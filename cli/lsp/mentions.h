// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cli/lsp/document.h"

#include <string>
#include <vector>

namespace keyline::lsp {

// A place where a node or a variable is named.
struct Mention {
    enum class Of { kNode, kVariable };
    Of of;
    std::string name;
    Span span;  // of the name alone
    bool is_definition = false;

    bool is_same(const Mention& m) const { return of == m.of && name == m.name; }
};

// All of a text, in its order: keys of `nodes`, `variables` and of what a group declares, links, ${…}, names
// in expressions.
std::vector<Mention> mentions_in(const Document& document);

// The one that a cursor touches; null where there is none.
const Mention* mention_at(const std::vector<Mention>& mentions, std::size_t byte);

}  // namespace keyline::lsp
