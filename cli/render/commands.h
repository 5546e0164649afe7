// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cli/common/command_line.h"

// The command that makes the frames.

namespace keyline::cli {

void add_render(const Command& program);

}  // namespace keyline::cli
