// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/input_check.h"

#include "engine/io/exr/chunk_table.h"
#include "engine/io/exr/metadata.h"
#include "engine/io/other_formats.h"
#include "engine/io/picture_structure.h"

#include <array>
#include <chrono>
#include <system_error>

namespace keyline {

void check_finished(const std::filesystem::path& name, const Rect& region) {
    const exr::InputFile file(name);
    std::array<std::byte, exr::kMagic.size()> start = {};
    file.read_some(0, start);
    if (start != exr::kMagic) return;
    uint64_t tables = 0;
    auto attributes = exr::read_attributes(file, &tables);
    const exr::ReadContext context(file);
    const std::vector<exr::Part> parts = exr::read_parts(file, context, std::move(attributes));
    exr::check_chunk_tables(file, context, parts, tables, &region);
}

bool is_at_rest(const std::filesystem::path& name) {
    using Clock = std::filesystem::file_time_type::clock;
    constexpr std::chrono::seconds kAtRest(5);
    if (!is_other_format(name)) return true;  // check_finished() knows
    if (has_known_structure(name) && size_of_whole_picture(name)) return true;
    std::error_code gone;
    const auto written = std::filesystem::last_write_time(name, gone);
    const auto age = Clock::now() - written;
    // A server's clock may be ahead.
    return !gone && (age > kAtRest || age < -kAtRest);
}

}  // namespace keyline
