// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"

#include <cstddef>
#include <filesystem>

// Formats other than OpenEXR are read and written by a helper program, which is started when the first such
// file is met: the libraries behind it are many, and a job without such files must not wait for them.

namespace KEYLINE_API keyline {

// Whether the picture helper reads and writes files of this name: all but OpenEXR's.
bool is_other_format(const std::filesystem::path& file);

// Whether files of this name can only hold whole numbers, which are made for a display unless somebody says
// otherwise.
bool holds_whole_numbers(const std::filesystem::path& file);

struct SinkSpec;

// What a picture becomes in a file of another format: in whole numbers; with R G B divided by A.  Nothing of
// either where the format can't hold it, which is told elsewhere.
struct InOtherFormat {
    bool whole_numbers = false, divided = false;
};
InOtherFormat in_other_format(const std::filesystem::path& file, const SinkSpec& spec);

// Whether the program was started and still runs.
bool picture_helper_runs();

// What the program and the libraries behind it take, as measured without a picture: most of it is the
// libraries' own start.  The processes of its sessions share that.
constexpr std::size_t kPictureHelperBytes = std::size_t{124} << 20;

}  // namespace keyline
