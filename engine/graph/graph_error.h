// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/error.h"
#include "engine/json/value.h"

#include <fmt/format.h>

namespace keyline {

// Tells a fault of a graph file or of the options that change it.
inline void graph_error(Diagnostics& diagnostics, const Place& place, std::string what, std::string hint = {},
                        std::string node = {}, Code code = Code::kNone) {
    diagnostics.error(
        {ErrorKind::kGraph, place, std::move(node), std::move(what), std::move(hint), Passing::kNever, code});
}

// Tells it of a member that must be text and is something else.
inline void check_text(const Member& m, Diagnostics& diagnostics, const std::string& node = {}) {
    if (!m.value.is(Value::Kind::kString))
        graph_error(diagnostics, m.value.place,
                    fmt::format("'{}' is {}; it must be a string", m.key, m.value.shown()), {}, node,
                    Code::kWrongValue);
}

}  // namespace keyline
