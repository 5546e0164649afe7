// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/params/missing_file.h"

#include "engine/base/error.h"
#include "engine/params/frames.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <vector>

namespace keyline {

namespace {

std::vector<std::string> names_in(const std::filesystem::path& folder) {
    std::vector<std::string> names;
    std::error_code error;  // a folder that is not there has none
    for (std::filesystem::directory_iterator i(folder.empty() ? "." : folder, error), end; !error && i != end;
         i.increment(error))
        names.push_back(i->path().filename().string());
    std::ranges::sort(names);
    return names;
}

}  // namespace

std::string hint_for_missing(const FileName& file, int frame) {
    if (const std::vector<int> frames = file.frames_on_disk(); !frames.empty())
        return "on disk are frames " + format_frames(frames);
    const std::filesystem::path path = file.at(frame);
    const std::string near = did_you_mean(path.filename().string(), names_in(path.parent_path()));
    if (!file.has_frame()) return near;
    return near.empty() ? "no frame of it is on disk" : "no frame of it is on disk; " + near;
}

}  // namespace keyline
