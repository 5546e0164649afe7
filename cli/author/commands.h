// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cli/common/command_line.h"

// Commands for those who begin a graph, and who hold it to what it is to do.

namespace keyline::cli {

void add_completion(const Command& program);
void add_explain(const Command& program);
void add_new(const Command& program);
void add_test(const Command& program);

}  // namespace keyline::cli
