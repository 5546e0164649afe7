// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/demand.h"

#include <algorithm>

namespace keyline {

bool Demand::needs(std::size_t op) const {
    return std::ranges::any_of(regions[op], [](const Rect& r) { return !r.empty(); });
}

Rect Demand::region(std::size_t op) const {
    Rect all;
    for (const Rect& r : regions[op]) all = unite(all, r);
    return all;
}

Rect demand_of_link(const Op& op, int slot, const Rect& out) {
    const Link& link = op.links[static_cast<std::size_t>(slot)];
    if (out.empty()) return {};
    if (op.operation->reduction()) return link.window;
    return intersect(op.operation->demand(out, slot), link.window);
}

Rect view_of_link(const Op& op, int slot, const Rect& out) {
    const bool here = op.operation->point();
    return here ? out : demand_of_link(op, slot, out);
}

Demand demand(const ResolvedFrame& frame) {
    Demand d;
    for (const Op& op : frame.ops) d.regions.emplace_back(op.outputs.size());
    const auto want = [&](ValueRef v, const Rect& region) {
        Rect& r = d.regions[static_cast<std::size_t>(v.op)][static_cast<std::size_t>(v.output)];
        r = unite(r, intersect(region, frame.info(v).window));
    };
    for (const Sink& sink : frame.sinks)
        for (const StreamChannel& c : sink.request.stream.channels) want(c.value, sink.request.stream.window);
    for (std::size_t i = frame.ops.size(); i-- > 0;) {
        const Op& op = frame.ops[i];
        if (op.source) continue;
        const Rect out = d.region(i);
        for (std::size_t slot = 0; slot < op.links.size(); ++slot)
            for (const ValueRef v : op.links[slot].values)
                want(v, demand_of_link(op, static_cast<int>(slot), out));
    }
    return d;
}

}  // namespace keyline
