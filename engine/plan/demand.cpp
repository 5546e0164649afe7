// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/plan/demand.h"

#include "engine/base/index.h"

#include <algorithm>

namespace keyline {

bool Demand::needs(std::size_t op) const {
    return data[op] || std::ranges::any_of(regions[op], [](const Rect& r) { return !r.empty(); });
}

Rect Demand::region(std::size_t op) const {
    Rect all;
    for (const Rect& r : regions[op]) all = unite(all, r);
    return all;
}

Rect demand_of_link(const Op& op, int slot, const Rect& out) {
    const Link& link = op.links[index(slot)];
    if (out.empty()) return {};
    return intersect(op.operation->demand(out, slot), link.window);
}

Rect view_of_link(const Op& op, int slot, const Rect& out) {
    // A point operation need not look where its input ends: it is given zeros there.
    if (op.operation->point() || out.empty()) return out;
    return intersect(op.operation->demand(out, slot), op.links[index(slot)].extent);
}

Rect end_of_link(const Op& op, int slot) {
    const Link& link = op.links[index(slot)];
    return op.operation && op.operation->point() ? link.window : link.extent;
}

Demand demand(const ResolvedFrame& frame) {
    Demand d;
    d.data.resize(frame.ops.size(), false);
    for (const Op& op : frame.ops) d.regions.emplace_back(op.outputs.size());
    const auto want = [&](ValueRef v, const Rect& region) {
        Rect& r = d.regions[index(v.op)][index(v.output)];
        r = unite(r, intersect(region, frame.info(v).window));
    };
    const auto want_datum = [&](ValueRef v) {
        if (v.op >= 0) d.data[index(v.op)] = true;
    };
    for (const Sink& sink : frame.sinks) {
        const Stream& stream = sink.request.stream;
        want_datum(stream.datum);
        for (const StreamChannel& c : stream.channels) want(c.value, stream.window);
    }
    // Backward through the frame's order: when an operation's turn comes, all who read it have had theirs.
    for (std::size_t i = frame.ops.size(); i-- > 0;) {
        const Op& op = frame.ops[i];
        if (op.source || !d.needs(i)) continue;
        const Rect out = d.region(i);
        for (std::size_t slot = 0; slot < op.links.size(); ++slot) {
            const Link& link = op.links[slot];
            want_datum(link.datum);
            for (const ValueRef v : link.values)
                want(v, op.gather ? link.window : demand_of_link(op, static_cast<int>(slot), out));
        }
    }
    return d;
}

}  // namespace keyline
