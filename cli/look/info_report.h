// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/io/describe_image.h"
#include "engine/json/json_writer.h"
#include "engine/look/objects.h"
#include "engine/look/statistics.h"

#include <optional>
#include <string>
#include <vector>

namespace keyline::cli {

// What was found in the pixels of one part in one view; only what was asked for.
struct Findings {
    std::string part, view;  // empty where the file has only one
    std::optional<std::vector<ChannelStatistics>> statistics;
    std::optional<std::vector<SeenCryptomatte>> objects;
    std::optional<Pixel> pixel;
};

struct FileReport {
    std::string file;
    ImageDescription image;
    std::vector<Findings> findings;
};

// "openexr, 480 × 270 at (0, 0), 22 channels" and a line a layer.  `more` goes to the end of the first line.
std::string short_text(const ImageDescription& image, const std::string& more = "");

// Storage and attributes too.
std::string long_text(const std::string& file, const ImageDescription& image);

// "" where nothing was asked for.
std::string findings_text(const FileReport& report);

// An object.
void write_report(JsonWriter& json, const FileReport& report);

}  // namespace keyline::cli
