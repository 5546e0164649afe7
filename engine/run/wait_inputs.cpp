// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/run/wait_inputs.h"

#include "engine/io/input_check.h"
#include "engine/io/system_call.h"
#include "engine/plan/demand.h"

#include <algorithm>
#include <fmt/format.h>

namespace keyline {

bool may_come(const std::vector<Error>& errors) {
    return !errors.empty() && std::ranges::all_of(errors, [](const Error& e) {
        return e.kind == ErrorKind::kInput && e.passing == Passing::kUnfinished;
    });
}

void check_at_rest(const ResolvedFrame& frame, Diagnostics& diagnostics) {
    const Demand demanded = demand(frame);
    for (std::size_t i = 0; i < frame.ops.size(); ++i) {
        const Op& op = frame.ops[i];
        if (!op.source || !demanded.needs(i) || op.source->header().file.empty()) continue;
        if (is_at_rest(op.source->header().file)) continue;
        diagnostics.error(
            {ErrorKind::kInput,
             {},
             op.title,
             fmt::format("{}: it was written to a moment ago", op.source->header().file.string()),
             kUnfinishedHint,
             Passing::kUnfinished});
    }
}

}  // namespace keyline
