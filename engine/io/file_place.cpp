// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/file_place.h"

#include "engine/io/output_file.h"

#include <sys/stat.h>

namespace keyline {

namespace fs = std::filesystem;

FilePlace place_of(const fs::path& file) {
    const fs::path target = behind_links(file);
    fs::path folder = target.parent_path(), rest = target.filename();
    struct stat status = {};
    while (stat(folder.empty() ? "." : folder.c_str(), &status) != 0) {
        if (folder.empty() || folder == folder.parent_path()) return {0, 0, target.string()};
        rest = folder.filename() / rest;
        folder = folder.parent_path();
    }
    return {status.st_dev, status.st_ino, rest.lexically_normal().string()};
}

}  // namespace keyline
