// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/input_check.h"

#include "engine/io/exr/chunk_table.h"
#include "engine/io/exr/metadata.h"

#include <array>

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

}  // namespace keyline
