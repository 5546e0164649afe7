// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace keyline::cli {

// What may stand where a shell's cursor is, a line each: the word, a tab, and what it is about; the line
// ":files" where files may.  `words` are those behind "keyline", the last as far as it is typed.  Commands,
// options and their words are those of the program; nodes, parameters and layers are those of the graph that
// is named.
std::string completions(const CLI::App& program, const std::vector<std::string>& words);

}  // namespace keyline::cli
