// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

// Files that are being written and have a name of their own for that time: how they are called, how others
// see that somebody is at work on one, and the end of those that nobody is at work on.

namespace keyline {

// ".keyline-MACHINE-RANDOM.EXT", new with every call.  It says nothing of the output but its extension, which
// some libraries choose a format by, so that it is short whatever the output is called.
std::string unfinished_name(const std::filesystem::path& output);

// Tells others that the file of a descriptor is being worked on, until the descriptor is closed.  False where
// another process has it: one that found it before it was claimed, and removes it.
bool claim(int descriptor);

// Removes the unfinished files in a folder that nobody is at work on, whoever made them.  Processes of the
// same machine, in containers too, see each other's claims; what another machine made is removed where nobody
// claims it and nobody wrote to it for a day.
void remove_unfinished(const std::filesystem::path& folder);

}  // namespace keyline
