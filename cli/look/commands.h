// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cli/common/command_line.h"

// Commands that show what files and nodes hold.

namespace keyline::cli {

void add_diff(const Command& program);
void add_draw(const Command& program);
void add_info(const Command& program);
void add_measure(const Command& program);
void add_view(const Command& program);

}  // namespace keyline::cli
