// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/plan/plan.h"

#include "engine/base/index.h"

namespace keyline {

std::size_t Store::row_bytes() const {
    std::size_t sum = 0;
    for (const SampleType t : types) sum += sample_size(t);
    return sum * static_cast<std::size_t>(region.width());
}

std::size_t Plan::carried_bytes() const {
    std::size_t sum = 0;
    for (const Store& s : stores) sum += s.carry_until ? s.bytes() : 0;
    for (const PlannedDatum& d : data) sum += d.carry_until ? d.bytes : 0;
    return sum;
}

std::vector<Rect> sample_tiles(const Sweep& sweep) {
    constexpr std::size_t kPlaces = 3;  // along each side
    const auto places = [](std::size_t n) {
        std::vector<std::size_t> out;
        for (std::size_t i = 0; i < kPlaces; ++i) {
            const std::size_t place = (2 * i + 1) * n / (2 * kPlaces);
            if (out.empty() || place > out.back()) out.push_back(place);
        }
        return out;
    };
    std::vector<Rect> tiles;
    if (sweep.columns.empty() || sweep.rows.empty()) return tiles;
    for (const std::size_t row : places(sweep.rows.size()))
        for (const std::size_t column : places(sweep.columns.size()))
            tiles.push_back(sweep.tile(column, row));
    return tiles;
}

std::vector<Rect> step_regions(const Plan& plan, const Sweep& sweep, const Rect& tile) {
    std::vector<Rect> regions(sweep.steps.size());
    // United into one rectangle a step: two readers far apart make it compute what lies between, which is
    // rare, and a step that ran twice would need twice the books.
    const auto want = [&](const Operand& o, const Rect& region) {
        if (o.step < 0) return;
        const Step& step = sweep.steps[index(o.step)];
        const int output = step.kind == Step::Kind::kLoad ? step.output : o.output;
        Rect& r = regions[index(o.step)];
        r = unite(r, intersect(region, plan.frame.info({step.op, output}).window));
    };
    for (const Root& root : sweep.roots) {
        std::size_t next = 0;
        if (root.kind == Root::Kind::kMap) {
            for (const Link& link : plan.frame.ops[index(root.op)].links)
                for (std::size_t k = 0; k < link.values.size(); ++k)
                    want(root.operands[next++], intersect(tile, link.window));
        } else {
            for (std::size_t k = 0; k < root.operands.size(); ++k)
                if (root.kind == Root::Kind::kKeep || !root.untouched[k])
                    want(root.operands[k], intersect(tile, root.region));
        }
    }
    // Backward, as demand() does for the frame: here for one tile.
    for (std::size_t i = sweep.steps.size(); i-- > 0;) {
        if (sweep.steps[i].kind != Step::Kind::kCompute) continue;
        const Op& op = plan.frame.ops[index(sweep.steps[i].op)];
        std::size_t next = 0;
        for (std::size_t slot = 0; slot < op.links.size(); ++slot) {
            const Rect region = demand_of_link(op, static_cast<int>(slot), regions[i]);
            for (std::size_t k = 0; k < op.links[slot].values.size(); ++k)
                want(sweep.operands[i][next++], region);
        }
    }
    return regions;
}

std::vector<Rect> store_regions(const Plan& plan, const Sweep& sweep, const Rect& tile) {
    std::vector<Rect> out(plan.stores.size());
    const auto want = [&](const Step& step, const Rect& region) {
        if (step.kind != Step::Kind::kLoad) return;
        Rect& r = out[index(step.store)];
        r = unite(r, region);
    };
    const std::vector<Rect> regions = step_regions(plan, sweep, tile);
    for (std::size_t i = 0; i < regions.size(); ++i) want(sweep.steps[i], regions[i]);
    // What is copied as bytes is read by the root itself, and by no step.
    for (const Root& root : sweep.roots)
        for (std::size_t k = 0; k < root.untouched.size(); ++k)
            if (root.untouched[k])
                want(sweep.steps[index(root.operands[k].step)], sink_region(plan, root, k, tile));
    return out;
}

Rect sink_region(const Plan& plan, const Root& root, std::size_t channel, const Rect& tile) {
    const Stream& stream = plan.frame.sinks[index(root.sink)].request.stream;
    return intersect(intersect(tile, root.region), plan.frame.info(stream.channels[channel].value).window);
}

}  // namespace keyline
