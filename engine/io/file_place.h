// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstdint>
#include <filesystem>
#include <string>

namespace keyline {

// Where a file stands, whatever the name it goes by: through links, or in a folder that is mounted twice.  It
// need not be there.  Two hard links of one file stand in two places: an output takes its place and leaves
// the file alone that stood there.
struct FilePlace {
    uint64_t device = 0, folder = 0;  // the nearest folder that is there
    std::string rest;                 // the name in it

    friend auto operator<=>(const FilePlace&, const FilePlace&) = default;
};

FilePlace place_of(const std::filesystem::path& file);

}  // namespace keyline
