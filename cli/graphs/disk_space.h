// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/run/render.h"

#include <cstdint>
#include <filesystem>
#include <map>

namespace keyline::cli {

// What the outputs of a shot take at most, on each of the file systems that they go to.
class DiskSpace {
public:
    void look(const ResolvedFrame& frame);

    // Warns where it is more than there is room for.
    void tell(Diagnostics& diagnostics) const;

private:
    struct Disk {
        std::filesystem::path folder;  // one of those that are written to
        double bytes = 0;              // beyond the outputs that are replaced
        std::size_t files = 0;
    };
    std::map<uint64_t, Disk> disks_;  // by device
};

}  // namespace keyline::cli
