// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace keyline::cli {

// docs/graphs.md, the language of graph files in full.
std::string_view manual_of_graphs();

}  // namespace keyline::cli
