// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace keyline::cli {

std::string base64(std::string_view bytes);

}  // namespace keyline::cli
