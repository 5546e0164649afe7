// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/error.h"
#include "tests/fuzz/mutate.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace keyline {

// What is damaged and tried, over and over.
struct Fuzz {
    std::string what;                                                // "OpenEXR files"
    std::vector<Victim> victims;                                     // sound ones
    std::filesystem::path folder;                                    // where the damaged one is put
    std::function<void(const std::filesystem::path& file)> attempt;  // may throw Failure
    std::function<bool(const Error& error)> is_fair;                 // of what attempt() throws
    // What the extension of the damaged file is: its victim's name's up to a dash where it is empty.
    std::string extension = {};
    std::function<Bytes(const Victim&, const Victim& other, Random&)> damage = damaged;
};

// PROGRAM [ITERATIONS [SEED [KIND]]]: damages victims, or those whose name holds KIND, and tries each.  Each
// must succeed or be refused with a fair Failure; the same arguments do the same.  A crash, another
// exception, or more memory than 1 GiB is a fault; the seed and the damaged file's number are named.  Returns
// the exit status.
int run_fuzz(Fuzz fuzz, int count, char** arguments);

// Reads the whole file.
Bytes content(const std::filesystem::path& file);

}  // namespace keyline
