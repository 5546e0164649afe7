// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/sweeps.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>

namespace keyline {

namespace {

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
            need.root.op = stores_[i].values.front().op;
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
        lay_grid(sweep);
        assign_slots(sweep);
        return sweep;
    }

    static void lay_grid(Sweep& sweep) {
        std::set<int> columns, rows;
        const auto cover = [](std::set<int>& lines, int from, int to, int size) {
            for (int line = floor_div(from, size); line <= floor_div(to - 1, size); ++line)
                lines.insert(line);
        };
        for (const Root& root : sweep.roots) {
            if (root.region.empty()) continue;
            cover(columns, root.region.x0, root.region.x1, sweep.tile_width);
            cover(rows, root.region.y0, root.region.y1, sweep.tile_height);
        }
        sweep.columns.assign(columns.begin(), columns.end());
        sweep.rows.assign(rows.begin(), rows.end());
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
        for (int o = 0; o < static_cast<int>(op(i).outputs.size()); ++o)
            step.slots.push_back(demand_.of({i, o}).empty() ? Step::kUnwanted : 0);
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
                if (slot == Step::kUnwanted) continue;
                if (free.empty()) free.push_back(sweep.slots++);
                slot = free.back();
                free.pop_back();
            }
            for (std::size_t j = 0; j <= i; ++j)
                if (last[j] == i)
                    std::ranges::remove_copy(sweep.steps[j].slots, std::back_inserter(free), Step::kUnwanted);
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

}  // namespace

void make_sweeps(Plan& plan, const Choices& choices) {
    Planner(plan.frame, plan.demand, choices).build(plan);
}

}  // namespace keyline
