// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cli/common/command_line.h"

// The command that serves editors.

namespace keyline::cli {

void add_lsp(const Command& program);

}  // namespace keyline::cli
