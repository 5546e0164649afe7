// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/error.h"

namespace keyline {

// Tells a fault of a graph file or of the options that change it.
inline void graph_error(Diagnostics& diagnostics, const Place& place, std::string what, std::string hint = {},
                        std::string node = {}) {
    diagnostics.error({ErrorKind::kGraph, place, std::move(node), std::move(what), std::move(hint)});
}

}  // namespace keyline
