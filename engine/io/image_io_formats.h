// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/io/image_sink.h"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// What is known of the formats behind OpenImageIO beyond what it tells itself.

namespace keyline::oiio {

// What an output format holds.
struct OutputFormat {
    std::string_view name = {};  // OpenImageIO's
    std::vector<std::string_view> extensions = {};
    std::vector<Depth> depths = {};  // the best first
    std::vector<std::string_view> channel_sets =
        {};                       // of "Y", "YA", "RGB", "RGBA"; "Y" is any single channel
    bool more_channels = false;   // any others after R G B (A), without their names
    bool straight_alpha = false;  // R G B are not multiplied by A in the file
    bool tiled = false;           // and in no other way
    std::vector<std::string_view> compressions = {};  // the default first; empty: no choice
    bool has_quality = false;                         // the first compression takes one, "jpeg:90", 1 to 100

    bool holds(std::string_view channel_set) const;
};

// By the file's extension, without regard to case.  Throws Failure (kGraph) that lists the extensions.
const OutputFormat& output_format(const std::filesystem::path& file);

// OpenImageIO's name of the format that a file is of: by its first bytes, and by its extension where these
// are those of no format or of a family (a camera's raw file begins as a TIFF does).  Empty: none.
//
// OpenImageIO itself would let every reader try in turn; some of them crash on what isn't theirs, and one
// makes a picture of anything.
std::string input_format(const std::filesystem::path& file, std::span<const std::byte> first_bytes);

// How many first bytes input_format() looks at.
inline constexpr std::size_t kFirstBytes = 256;

// An extension of every format that can be read, in alphabetical order.
std::vector<std::string> input_extensions();

// "a b c"
std::string spaced(const std::vector<std::string>& words);

const char* depth_name(Depth depth);

}  // namespace keyline::oiio
