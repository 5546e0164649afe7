// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/graph/enabled.h"

namespace keyline {

namespace {

const TypeInfo kTruth = TypeInfo::boolean();

}  // namespace

std::optional<bool> is_enabled_at(const GraphNode& node, int frame, Diagnostics& diagnostics) {
    if (!node.enabled || node.variables().uses_faulty(*node.enabled, &kTruth)) return true;
    Diagnostics faults;
    const Value value = node.variables().evaluate(*node.enabled, kTruth, {frame}, faults);
    ParamReader reader(faults, node.title(), {});
    if (faults.ok()) validate(kTruth, value, "enabled", reader);
    for (Error e : faults.errors()) {
        if (e.node.empty()) e.node = node.title();
        diagnostics.error(std::move(e));
    }
    return faults.ok() ? std::optional(value.boolean) : std::nullopt;
}

bool enabled_moves(const GraphNode& node) {
    return node.enabled && node.variables().uses_frame(*node.enabled, &kTruth);
}

}  // namespace keyline
