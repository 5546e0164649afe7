// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/graph/read_text.h"

#include "engine/base/error.h"

#include <cerrno>
#include <fmt/format.h>
#include <fstream>
#include <iostream>
#include <sstream>

namespace keyline {

std::string read_text(const std::filesystem::path& file, const std::string& what) {
    std::ostringstream text;
    if (file == "-") return text << std::cin.rdbuf(), text.str();
    std::error_code error;
    const auto cannot = [&](const std::string& why) {
        const Code code = std::filesystem::exists(file, error) ? Code::kNone : Code::kFileMissing;
        fail(code, ErrorKind::kGraph,
             fmt::format("cannot read {} {}: {}", what, in_quotes(file.string()), why));
    };
    if (std::filesystem::is_directory(file, error)) cannot("it is a folder");
    std::ifstream in(file, std::ios::binary);
    if (!in) cannot(std::generic_category().message(errno));
    text << in.rdbuf();
    return text.str();
}

}  // namespace keyline
