// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/params/param_types.h"

#include <optional>
#include <string>
#include <string_view>

// A colour or a number for each object, in a file of its own: as JSON, { "hair*": "#302018", "*": [0.2, 0.2,
// 0.2] }, or as CSV, which spreadsheets make:
//
//     name,color
//     hair*,#302018
//     *,0.2,0.2,0.2
//
// In both the first name that matches counts.  A first line of words is a heading.

namespace KEYLINE_API keyline {

struct ObjectTable {
    std::optional<Map<Color>> colors;  // one of the two
    std::optional<Map<double>> values;
};

// What a file's text says; the name's ending tells which it is.  Throws Failure (kInput) with the place in
// the file.
ObjectTable parse_object_table(std::string_view text, const std::string& file);

}  // namespace keyline
