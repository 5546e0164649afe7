// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace CLI {
class App;
}  // namespace CLI

namespace keyline::cli {

// All commands below one with their arguments and options, as Markdown: what the manual is made of.
std::string commands_markdown(const CLI::App& program);

}  // namespace keyline::cli
