// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cli/common/command_line.h"

// Commands about a graph file and the words that it is written in.

namespace keyline::cli {

void add_check(const Command& program);
void add_fmt(const Command& program);
void add_nodes(const Command& program);
void add_plan(const Command& program);
void add_schema(const Command& program);

}  // namespace keyline::cli
