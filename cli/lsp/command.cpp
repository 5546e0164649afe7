// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/common/commands.h"
#include "cli/lsp/server.h"

#include <unistd.h>

namespace keyline::cli {

void add_lsp(CLI::App& program, Chosen& chosen) {
    CLI::App& command = *program.add_subcommand(
        "lsp",
        "Help for editors while one types: the Language Server Protocol over standard input and output");
    // What the clients of some editors add for themselves.
    command.add_flag("--stdio")->description("Over standard input and output, which is so in any case");
    command.callback([&chosen] {
        chosen = [] { return lsp::Server(lsp::Connection(STDIN_FILENO, STDOUT_FILENO)).run(); };
    });
}

}  // namespace keyline::cli
