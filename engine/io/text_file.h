// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace KEYLINE_API keyline {

inline constexpr std::size_t kMostText = std::size_t{64} << 20;

// The bytes of an input of text.  Throws Failure (kInput) for what is not there, can't be read, is no regular
// file, or holds more than kMostText.
std::string read_text_file(const std::filesystem::path& file);

// Makes an output of text, which appears whole.  Throws Failure (kOutput) as OutputFile does.
void write_text_file(const std::filesystem::path& file, std::string_view text);

}  // namespace keyline
