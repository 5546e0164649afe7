// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cli/common/command_line.h"

// Commands of who lets many machines render and has to trust what comes back.

namespace keyline::cli {

void add_provenance(const Command& program);
void add_submit(const Command& program);
void add_verify(const Command& program);

}  // namespace keyline::cli
