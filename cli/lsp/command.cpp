// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/lsp/commands.h"
#include "cli/lsp/server.h"

#include <unistd.h>

namespace keyline::cli {

void add_lsp(const Command& program) {
    const Command command = program.add(
        "lsp",
        "Help for editors while one types: the Language Server Protocol over standard input and output");
    // What the clients of some editors add for themselves.
    command.flag("--stdio", "Over standard input and output, which is so in any case");
    command.runs([] { return lsp::Server(lsp::Connection(STDIN_FILENO, STDOUT_FILENO)).run(); });
}

}  // namespace keyline::cli
