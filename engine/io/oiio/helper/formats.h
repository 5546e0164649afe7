// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// What is known of the formats behind OpenImageIO beyond what it tells itself.

namespace keyline::oiio {

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

}  // namespace keyline::oiio
