// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/json/json_tree.h"
#include "engine/json/value.h"

#include <string>
#include <string_view>

namespace KEYLINE_API keyline {

// What a text says as far as it is whole, with the places that parse_json() gives: items without a value, and
// keys that were there before, are left out.
Value read_what_is_whole(const JsonDocument& document, std::string_view text, const std::string& file);

// Whether something in it is missing or not closed.
bool is_torn(const JsonTree& tree, std::string_view text);

// What a key or a string says, quotes and escapes taken off as far as they are sound.
std::string json_string(std::string_view raw);

}  // namespace keyline
