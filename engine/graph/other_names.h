// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace keyline {

// What a node type is called here that has another name in other programs: "Blur is 'gaussian' here"; ""
// where nothing is known by the name.
std::string own_name_of(std::string_view type);

}  // namespace keyline
