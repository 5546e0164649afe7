// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/plan.h"

#include "engine/plan_memory.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <set>

namespace keyline {

namespace {

// What the planner may trade for memory, and never pixels.
struct Choices {
    bool keep_sources = true;   // decoded samples that a later sweep needs again, or decode again
    bool keep_computed = true;  // likewise results of stencils, or compute them again
    int tile_width = 256, tile_height = 64;
    int rows_ahead = 2;
};

class Planner {
public:
    Planner(const ResolvedFrame& frame, const Demand& demand, const Choices& choices)
        : frame_(frame), demand_(demand), choices_(choices) {}

    // Fills stores and sweeps of `plan`.
    void build(Plan& plan) {
        find_availability();
        find_roots();
        if (choices_.keep_computed) choose_kept();
        make_stores();
        for (int s = 0; s < sweep_count_; ++s) plan.sweeps.push_back(make_sweep(s));
        plan.stores = std::move(stores_);
    }

private:
    const Op& op(int i) const { return frame_.ops[static_cast<std::size_t>(i)]; }
    bool is_reduction(int i) const { return op(i).operation && op(i).operation->reduction(); }

    // The first sweep in which an operation's result can be had.
    void find_availability() {
        available_.assign(frame_.ops.size(), 0);
        inputs_ready_.assign(frame_.ops.size(), 0);
        for (std::size_t i = 0; i < frame_.ops.size(); ++i) {
            int ready = 0;
            for (const Link& link : frame_.ops[i].links)
                for (const ValueRef v : link.values) ready = std::max(ready, available(v));
            const Reduction* r = frame_.ops[i].operation ? frame_.ops[i].operation->reduction() : nullptr;
            inputs_ready_[i] = ready;
            available_[i] = ready + (r ? r->rounds() : 0);
        }
    }
    int available(ValueRef v) const { return available_[static_cast<std::size_t>(v.op)]; }

    struct RootNeed {
        Root root;
        std::vector<ValueRef> values;
    };

    void find_roots() {
        for (int i = 0; i < static_cast<int>(frame_.ops.size()); ++i) {
            if (!is_reduction(i) || !demand_.needs(static_cast<std::size_t>(i))) continue;
            const int first = inputs_ready_[static_cast<std::size_t>(i)];
            for (int round = 0; round < op(i).operation->reduction()->rounds(); ++round)
                add_map(i, first + round);
        }
        for (int i = 0; i < static_cast<int>(frame_.sinks.size()); ++i) add_sink(i);
        sweep_count_ = static_cast<int>(roots_.size());
    }

    void add_map(int i, int sweep) {
        RootNeed need;
        need.root.kind = Root::Kind::kMap;
        need.root.op = i;
        for (const Link& link : op(i).links) {
            need.root.region = unite(need.root.region, link.window);
            need.values.insert(need.values.end(), link.values.begin(), link.values.end());
        }
        roots_at(sweep).push_back(std::move(need));
    }

    void add_sink(int i) {
        const Stream& stream = frame_.sinks[static_cast<std::size_t>(i)].request.stream;
        RootNeed need;
        need.root.kind = Root::Kind::kSink;
        need.root.sink = i;
        need.root.region = stream.window;
        int sweep = 0;
        for (const StreamChannel& c : stream.channels) {
            need.values.push_back(c.value);
            sweep = std::max(sweep, available(c.value));
        }
        roots_at(sweep).push_back(std::move(need));
    }

    std::vector<RootNeed>& roots_at(int sweep) {
        if (static_cast<int>(roots_.size()) <= sweep) roots_.resize(static_cast<std::size_t>(sweep) + 1);
        return roots_[static_cast<std::size_t>(sweep)];
    }

    // Whether sweep s reads a value from a store rather than computing it.
    bool is_stored(ValueRef v, int sweep) const {
        if (op(v.op).source) return true;
        const auto it = kept_.find(v);
        return it != kept_.end() && it->second.first < sweep;
    }

    // Values that sweep s reads from stores, and operations that it computes, from `values` backward.
    struct Closure {
        std::set<ValueRef> loads;
        std::set<int> ops;
    };

    Closure closure(int sweep) const {
        Closure c;
        std::vector<ValueRef> open;
        for (const RootNeed& r : roots_[static_cast<std::size_t>(sweep)])
            open.insert(open.end(), r.values.begin(), r.values.end());
        while (!open.empty()) {
            const ValueRef v = open.back();
            open.pop_back();
            if (demand_.of(v).empty()) continue;
            if (is_stored(v, sweep)) {
                c.loads.insert(v);
            } else if (c.ops.insert(v.op).second && !is_reduction(v.op)) {
                for (const Link& link : op(v.op).links)
                    open.insert(open.end(), link.values.begin(), link.values.end());
            }
        }
        return c;
    }

    // A result is kept for a later sweep where computing it again would run a stencil: point operations on
    // what is stored cost less than the memory.
    void choose_kept() {
        std::map<int, int> computed_in;  // operation → the first sweep that computes it
        for (int s = 0; s < sweep_count_; ++s) {
            const Closure c = closure(s);
            for (const int i : c.ops) {
                if (is_reduction(i)) continue;
                computed_in.emplace(i, s);
            }
            keep_frontier(s, c, computed_in);
        }
    }

    void keep_frontier(int sweep, const Closure& c, const std::map<int, int>& computed_in) {
        const auto earlier = [&](int i) {
            const auto it = computed_in.find(i);
            return it != computed_in.end() && it->second < sweep;
        };
        const auto consider = [&](ValueRef v) {
            if (op(v.op).source || is_stored(v, sweep) || !c.ops.contains(v.op) || !earlier(v.op)) return;
            if (runs_stencil(v, sweep)) kept_.try_emplace(v, computed_in.at(v.op), sweep);
        };
        for (const RootNeed& r : roots_[static_cast<std::size_t>(sweep)])
            for (const ValueRef v : r.values) consider(v);
        for (const int i : c.ops) {
            if (earlier(i) || is_reduction(i)) continue;
            for (const Link& link : op(i).links)
                for (const ValueRef v : link.values) consider(v);
        }
    }

    bool runs_stencil(ValueRef v, int sweep) const {
        std::vector<ValueRef> open{v};
        std::set<int> seen;
        while (!open.empty()) {
            const ValueRef next = open.back();
            open.pop_back();
            if (is_stored(next, sweep) || is_reduction(next.op) || !seen.insert(next.op).second) continue;
            if (!op(next.op).operation->point()) return true;
            for (const Link& link : op(next.op).links)
                open.insert(open.end(), link.values.begin(), link.values.end());
        }
        return false;
    }

    void make_stores() {
        for (auto& [value, sweeps] : kept_) {
            for (int s = sweeps.first + 1; s < sweep_count_; ++s)
                if (closure(s).loads.contains(value)) sweeps.second = s;
            Store store;
            store.values = {value};
            store.types = {SampleType::kFloat};
            store.region = demand_.of(value);
            store.band_height = choices_.tile_height;
            store.first_sweep = sweeps.first;
            store.last_sweep = sweeps.second;
            stores_.push_back(std::move(store));
        }
        for (int s = 0; s < sweep_count_; ++s)
            for (const ValueRef v : closure(s).loads)
                if (op(v.op).source) add_to_source_store(v, s);
        add_kept_roots();
    }

    void add_kept_roots() {
        for (std::size_t i = 0; i < stores_.size(); ++i) {
            if (stores_[i].source_op >= 0) continue;
            RootNeed need;
            need.root.kind = Root::Kind::kKeep;
            need.root.store = static_cast<int>(i);
            need.root.region = stores_[i].region;
            need.values = stores_[i].values;
            roots_at(stores_[i].first_sweep).push_back(std::move(need));
        }
    }

    void add_to_source_store(ValueRef v, int sweep) {
        const std::size_t output = static_cast<std::size_t>(v.output), group = op(v.op).source_group[output];
        auto it = std::ranges::find_if(stores_, [&](const Store& s) {
            return s.source_op == v.op && s.group == group &&
                   (choices_.keep_sources || s.first_sweep == sweep);
        });
        if (it == stores_.end()) {
            const ChannelGroup& g = op(v.op).source->header().groups[group];
            Store store;
            store.source_op = v.op;
            store.group = group;
            store.band_origin = g.window.y0;
            store.band_height = g.chunk_height;
            store.first_sweep = sweep;
            stores_.push_back(std::move(store));
            it = stores_.end() - 1;
        }
        it->last_sweep = sweep;
        it->region = unite(it->region, demand_.of(v));
        if (std::ranges::find(it->values, v) != it->values.end()) return;
        it->values.push_back(v);
        it->types.push_back(*frame_.info(v).stored);
    }

    Sweep make_sweep(int s) {
        Sweep sweep;
        const Closure c = closure(s);
        step_of_.clear();
        for (const ValueRef v : c.loads) add_load(sweep, v, s);
        for (const int i : c.ops) add_compute(sweep, i);
        for (RootNeed& need : roots_[static_cast<std::size_t>(s)]) {
            for (const ValueRef v : need.values) need.root.operands.push_back(operand(v));
            if (need.root.kind == Root::Kind::kSink) mark_untouched(need, sweep);
            sweep.area = unite(sweep.area, need.root.region);
            sweep.roots.push_back(need.root);
        }
        for (std::size_t i = 0; i < stores_.size(); ++i)
            if (stores_[i].source_op >= 0 && stores_[i].first_sweep == s)
                sweep.reads.push_back(static_cast<int>(i));
        sweep.tile_width = choices_.tile_width;
        sweep.tile_height = choices_.tile_height;
        assign_slots(sweep);
        return sweep;
    }

    void mark_untouched(RootNeed& need, const Sweep& sweep) const {
        const SinkSpec& spec = frame_.sinks[static_cast<std::size_t>(need.root.sink)].request.spec;
        for (std::size_t k = 0; k < need.values.size(); ++k) {
            const Operand& o = need.root.operands[k];
            const bool loaded =
                o.step >= 0 && sweep.steps[static_cast<std::size_t>(o.step)].kind == Step::Kind::kLoad;
            need.root.untouched.push_back(loaded &&
                                          frame_.info(need.values[k]).stored == spec.channels[k].type);
        }
    }

    void add_load(Sweep& sweep, ValueRef v, int s) {
        Step step;
        step.kind = Step::Kind::kLoad;
        step.op = v.op;
        step.output = v.output;
        for (std::size_t i = 0; i < stores_.size(); ++i) {
            const auto it = std::ranges::find(stores_[i].values, v);
            if (it == stores_[i].values.end() || s < stores_[i].first_sweep || s > stores_[i].last_sweep)
                continue;
            step.store = static_cast<int>(i);
            step.plane = static_cast<int>(it - stores_[i].values.begin());
        }
        step.slots.resize(1);
        step_of_[v] = {static_cast<int>(sweep.steps.size()), 0};
        sweep.steps.push_back(std::move(step));
        sweep.operands.emplace_back();
    }

    void add_compute(Sweep& sweep, int i) {
        Step step;
        step.kind = is_reduction(i) ? Step::Kind::kApply : Step::Kind::kCompute;
        step.op = i;
        step.slots.resize(op(i).outputs.size());
        std::vector<Operand> operands;
        if (step.kind == Step::Kind::kCompute)
            for (const Link& link : op(i).links)
                for (const ValueRef v : link.values) operands.push_back(operand(v));
        for (int o = 0; o < static_cast<int>(op(i).outputs.size()); ++o)
            step_of_.try_emplace({i, o}, Operand{static_cast<int>(sweep.steps.size()), o});
        sweep.steps.push_back(std::move(step));
        sweep.operands.push_back(std::move(operands));
    }

    // Nowhere: a value that is 0 wherever it is looked at.
    Operand operand(ValueRef v) const {
        const auto it = step_of_.find(v);
        return it == step_of_.end() ? Operand{} : it->second;
    }

    // Scratch buffers are handed out first come, first served, and again once their last reader is done.
    static void assign_slots(Sweep& sweep) {
        const std::size_t n = sweep.steps.size();
        std::vector<std::size_t> last(n);
        for (std::size_t i = 0; i < n; ++i) {
            last[i] = i;
            for (const Operand& o : sweep.operands[i])
                if (o.step >= 0) last[static_cast<std::size_t>(o.step)] = i;
        }
        for (const Root& r : sweep.roots)
            for (const Operand& o : r.operands)
                if (o.step >= 0) last[static_cast<std::size_t>(o.step)] = n;
        std::vector<int> free;
        for (std::size_t i = 0; i < n; ++i) {
            for (int& slot : sweep.steps[i].slots) {
                if (free.empty()) free.push_back(sweep.slots++);
                slot = free.back();
                free.pop_back();
            }
            for (std::size_t j = 0; j <= i; ++j)
                if (last[j] == i)
                    free.insert(free.end(), sweep.steps[j].slots.begin(), sweep.steps[j].slots.end());
        }
    }

    const ResolvedFrame& frame_;
    const Demand& demand_;
    const Choices choices_;
    std::vector<int> available_, inputs_ready_;  // by operation: sweeps
    std::vector<std::vector<RootNeed>> roots_;   // by sweep
    int sweep_count_ = 0;
    std::map<ValueRef, std::pair<int, int>>
        kept_;  // computed values kept: the sweeps that make and last use them
    std::vector<Store> stores_;
    std::map<ValueRef, Operand> step_of_;
};

// Pixels computed over pixels wanted, weighted by what the operations cost: 1 without halos.
double halo_overhead(const Plan& plan, const Sweep& sweep) {
    if (sweep.area.empty()) return 1;
    const Rect tile = intersect({0, 0, sweep.tile_width, sweep.tile_height},
                                {0, 0, sweep.area.width(), sweep.area.height()});
    const Rect middle = translate(tile, sweep.area.x0 + (sweep.area.width() - tile.width()) / 2,
                                  sweep.area.y0 + (sweep.area.height() - tile.height()) / 2);
    const std::vector<Rect> regions = step_regions(plan, sweep, middle);
    double spent = 1, wanted = 1;
    for (std::size_t i = 0; i < regions.size(); ++i) {
        const Op& op = plan.frame.ops[static_cast<std::size_t>(sweep.steps[i].op)];
        const double cost = op.operation ? op.operation->cost() : 1;
        spent += cost * static_cast<double>(regions[i].area());
        wanted += cost * static_cast<double>(std::min(regions[i].area(), middle.area()));
    }
    return spent / wanted;
}

constexpr double kTolerableOverhead = 1.5;

int rows_ahead_for(const Plan& plan, int threads) {
    int columns = 1;
    for (const Sweep& s : plan.sweeps) columns = std::max(columns, s.end_column() - s.first_column());
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
        std::size_t least = SIZE_MAX;
        for (const Choices& c : candidates(choices)) {
            build(c);
            if (options_.memory == 0 || plan_.memory_bytes <= options_.memory) return std::move(plan_);
            least = std::min(least, plan_.memory_bytes);
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
        Planner(plan_.frame, plan_.demand, c).build(plan_);
        plan_.rows_ahead = std::min(c.rows_ahead, rows_ahead_for(plan_, options_.threads));
        estimate_memory(plan_);
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
