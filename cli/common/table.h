// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace keyline::cli {

using Row = std::vector<std::string>;

// Lines of columns, each as wide as its widest entry; a character is one cell.  The last column is as it is.
std::string table(const std::vector<Row>& rows, const std::string& indent = "");

}  // namespace keyline::cli
