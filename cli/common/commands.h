// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

// The program's commands, a file each.  Each adds itself to the command line; the one that the user names
// puts what is to be done into `chosen`, which returns the exit status and throws Failure.

namespace keyline::cli {

using Chosen = std::function<int()>;

void add_render(CLI::App& program, Chosen& chosen);
void add_check(CLI::App& program, Chosen& chosen);
void add_plan(CLI::App& program, Chosen& chosen);
void add_lsp(CLI::App& program, Chosen& chosen);
void add_fmt(CLI::App& program, Chosen& chosen);
void add_nodes(CLI::App& program, Chosen& chosen);
void add_schema(CLI::App& program, Chosen& chosen);
void add_submit(CLI::App& program, Chosen& chosen);
void add_verify(CLI::App& program, Chosen& chosen);
void add_provenance(CLI::App& program, Chosen& chosen);
void add_measure(CLI::App& program, Chosen& chosen);
void add_info(CLI::App& program, Chosen& chosen);
void add_diff(CLI::App& program, Chosen& chosen);
void add_view(CLI::App& program, Chosen& chosen);
void add_draw(CLI::App& program, Chosen& chosen);

}  // namespace keyline::cli
