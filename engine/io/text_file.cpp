// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/text_file.h"

#include "engine/base/error.h"
#include "engine/io/output_file.h"

#include <cerrno>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <span>
#include <system_error>

namespace keyline {

std::string read_text_file(const std::filesystem::path& file) {
    const auto refuse = [&](std::string_view why) {
        fail(ErrorKind::kInput, fmt::format("{}: {}", file.string(), why));
    };
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(file, error);
    if (status.type() == std::filesystem::file_type::not_found)
        fail(Code::kFileMissing, ErrorKind::kInput, file.string() + ": no such file");
    if (error) refuse(error.message());
    if (status.type() != std::filesystem::file_type::regular) refuse("it is no regular file");
    if (std::filesystem::file_size(file, error) > kMostText)
        refuse(fmt::format("it is larger than {} MiB, and is not read", kMostText >> 20));
    std::ifstream in(file, std::ios::binary);
    if (!in) refuse(std::generic_category().message(errno));
    std::string text{std::istreambuf_iterator<char>(in), {}};
    if (in.bad()) refuse("it can't be read");
    return text;
}

void write_text_file(const std::filesystem::path& file, std::string_view text) {
    OutputFile out(file);
    out.append(std::as_bytes(std::span(text)));
    out.publish();
}

}  // namespace keyline
