// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/plan/plan.h"

#include <fmt/format.h>

// What plans are made of, as a failed test or a debugger shows it; `keyline plan` is for people.

namespace keyline {

std::string to_string(const Store& store) {
    std::string out = store.source_op < 0 ? "computed:" : fmt::format("decoded from {}:", store.source_op);
    for (const ValueRef v : store.values) out += fmt::format(" {}", to_string(v));
    return out + fmt::format(", {}, bands of {} rows, sweeps {} to {}", to_string(store.region),
                             store.band_height, store.first_sweep + 1, store.last_sweep + 1);
}

std::string to_string(const Step& step) {
    std::string out;
    switch (step.kind) {
        case Step::Kind::kLoad:
            out = fmt::format("load {} from plane {} of store {}", to_string(ValueRef{step.op, step.output}),
                              step.plane, step.store);
            break;
        case Step::Kind::kCompute: out = fmt::format("compute {}", step.op); break;
    }
    out += " into";
    for (const int slot : step.slots) out += slot == Step::kUnwanted ? " -" : fmt::format(" {}", slot);
    return out;
}

std::string to_string(const Root& root) {
    std::string out;
    switch (root.kind) {
        case Root::Kind::kMap: out = fmt::format("map {}", root.op); break;
        case Root::Kind::kSink: out = fmt::format("sink {}", root.sink); break;
        case Root::Kind::kKeep: out = fmt::format("keep in store {}", root.store); break;
    }
    return out + ", " + to_string(root.region);
}

std::string to_string(const Sweep& sweep) {
    std::string out =
        fmt::format("{} in {} × {} tiles of {} × {}", to_string(sweep.area), sweep.columns.size(),
                    sweep.rows.size(), sweep.tile_width, sweep.tile_height);
    for (const Step& step : sweep.steps) out += "\n  " + to_string(step);
    for (const Root& root : sweep.roots) out += "\n  " + to_string(root);
    return out;
}

}  // namespace keyline
