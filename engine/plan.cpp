// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/plan.h"

#include "engine/plan_cost.h"
#include "engine/plan_memory.h"
#include "engine/sweeps.h"

#include <algorithm>
#include <fmt/format.h>

namespace keyline {

namespace {

constexpr double kTolerableOverhead = 1.5;

int rows_ahead_for(const Plan& plan, int threads) {
    int columns = 1;
    for (const Sweep& s : plan.sweeps) columns = std::max(columns, static_cast<int>(s.columns.size()));
    return 2 + (2 * threads + columns - 1) / columns;
}

class Search {
public:
    Search(ResolvedFrame frame, const PlanOptions& options) : options_(options) {
        plan_.frame = std::move(frame);
        plan_.demand = demand(plan_.frame);
        plan_.threads = options.threads;
    }

    Plan run() {
        Choices choices;
        if (options_.tile > 0)
            choices.tile_width = choices.tile_height = options_.tile;
        else
            grow_tiles(choices);
        const std::vector<Choices> all = candidates(choices);
        std::vector<Weighed> weighed = options_.weigh_all ? weigh(all) : std::vector<Weighed>{};
        std::size_t least = SIZE_MAX;
        for (const Choices& c : all) {
            build(c);
            least = std::min(least, plan_.memory_bytes);
            if (options_.memory > 0 && plan_.memory_bytes > options_.memory) continue;
            plan_.weighed = std::move(weighed);
            return std::move(plan_);
        }
        fail(ErrorKind::kGraph,
             fmt::format("the memory limit is {}; frame {} needs at least {}", memory_text(options_.memory),
                         plan_.frame.frame, memory_text(least)),
             fmt::format("give --memory {}", memory_text(least)));
    }

private:
    void build(const Choices& c) {
        plan_.stores.clear();
        plan_.sweeps.clear();
        make_sweeps(plan_, c);
        plan_.rows_ahead = std::min(c.rows_ahead, rows_ahead_for(plan_, options_.threads));
        estimate_memory(plan_);
        estimate_work(plan_);
    }

    // Without those that save no memory: one before is as good.
    std::vector<Weighed> weigh(const std::vector<Choices>& all) {
        std::vector<Weighed> out;
        for (const Choices& c : all) {
            build(c);
            if (!out.empty() && plan_.memory_bytes >= out.back().memory_bytes) continue;
            out.push_back({c.keep_sources, c.keep_computed, c.tile_width, c.tile_height, plan_.rows_ahead,
                           plan_.work, plan_.memory_bytes});
        }
        return out;
    }

    // Large halos want large tiles, or most of the work is done again by the neighbours.
    void grow_tiles(Choices& choices) {
        for (;;) {
            build(choices);
            double overhead = 1;
            Rect area;
            for (const Sweep& s : plan_.sweeps) {
                overhead = std::max(overhead, halo_overhead(plan_, s));
                area = unite(area, s.area);
            }
            if (overhead < kTolerableOverhead) return;
            const bool wide = choices.tile_width >= area.width(), high = choices.tile_height >= area.height();
            if (wide && high) return;
            if (!high && (choices.tile_height < choices.tile_width || wide))
                choices.tile_height *= 2;
            else
                choices.tile_width *= 2;
        }
    }

    // From the fastest to the smallest.
    std::vector<Choices> candidates(Choices c) const {
        std::vector<Choices> out;
        c.rows_ahead = INT32_MAX;
        out.push_back(c);
        c.rows_ahead = 2;
        out.push_back(c);
        c.keep_computed = false;
        out.push_back(c);
        c.keep_sources = false;
        out.push_back(c);
        while (options_.tile == 0 && c.tile_width * c.tile_height > 32 * 32) {
            (c.tile_width > c.tile_height ? c.tile_width : c.tile_height) /= 2;
            out.push_back(c);
        }
        c.rows_ahead = 1;
        out.push_back(c);
        return out;
    }

    Plan plan_;
    const PlanOptions options_;
};

}  // namespace

std::size_t Store::row_bytes() const {
    std::size_t sum = 0;
    for (const SampleType t : types) sum += sample_size(t);
    return sum * static_cast<std::size_t>(region.width());
}

std::vector<Rect> step_regions(const Plan& plan, const Sweep& sweep, const Rect& tile) {
    std::vector<Rect> regions(sweep.steps.size());
    const auto want = [&](const Operand& o, const Rect& region) {
        if (o.step < 0) return;
        const Step& step = sweep.steps[static_cast<std::size_t>(o.step)];
        const int output = step.kind == Step::Kind::kLoad ? step.output : o.output;
        Rect& r = regions[static_cast<std::size_t>(o.step)];
        r = unite(r, intersect(region, plan.frame.info({step.op, output}).window));
    };
    for (const Root& root : sweep.roots) {
        std::size_t next = 0;
        if (root.kind == Root::Kind::kMap) {
            for (const Link& link : plan.frame.ops[static_cast<std::size_t>(root.op)].links)
                for (std::size_t k = 0; k < link.values.size(); ++k)
                    want(root.operands[next++], intersect(tile, link.window));
        } else {
            for (std::size_t k = 0; k < root.operands.size(); ++k)
                if (root.kind == Root::Kind::kKeep || !root.untouched[k])
                    want(root.operands[k], intersect(tile, root.region));
        }
    }
    for (std::size_t i = sweep.steps.size(); i-- > 0;) {
        if (sweep.steps[i].kind != Step::Kind::kCompute) continue;
        const Op& op = plan.frame.ops[static_cast<std::size_t>(sweep.steps[i].op)];
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
        Rect& r = out[static_cast<std::size_t>(step.store)];
        r = unite(r, region);
    };
    const std::vector<Rect> regions = step_regions(plan, sweep, tile);
    for (std::size_t i = 0; i < regions.size(); ++i) want(sweep.steps[i], regions[i]);
    for (const Root& root : sweep.roots)
        for (std::size_t k = 0; k < root.untouched.size(); ++k)
            if (root.untouched[k])
                want(sweep.steps[static_cast<std::size_t>(root.operands[k].step)],
                     sink_region(plan, root, k, tile));
    return out;
}

Rect sink_region(const Plan& plan, const Root& root, std::size_t channel, const Rect& tile) {
    const Stream& stream = plan.frame.sinks[static_cast<std::size_t>(root.sink)].request.stream;
    return intersect(intersect(tile, root.region), plan.frame.info(stream.channels[channel].value).window);
}

Plan make_plan(ResolvedFrame frame, const PlanOptions& options) {
    return Search(std::move(frame), options).run();
}

}  // namespace keyline
