// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/base/print.h"

#include <fmt/format.h>

namespace keyline {

std::string to_string(const Rect& rect) {
    if (rect.empty()) return "empty";
    return fmt::format("{} × {} at ({}, {})", rect.width(), rect.height(), rect.x0, rect.y0);
}

}  // namespace keyline
