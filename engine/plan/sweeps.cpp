// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/plan/sweeps.h"

#include "engine/base/index.h"
#include "engine/plan/kept.h"
#include "engine/plan/lifetimes.h"
#include "engine/plan/schedule.h"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <map>
#include <optional>
#include <set>

namespace keyline {

namespace {

// Lays out stores and sweeps from the division of the work.
class SweepMaker {
public:
    SweepMaker(const Plan& plan, const Choices& choices)
        : frame_(plan.frame),
          demand_(plan.demand),
          carrying_(plan.carrying),
          choices_(choices),
          schedule_(make_schedule(frame_, carrying_)),
          division_(divide_work(frame_, demand_, carrying_, schedule_, choices.keep_computed)) {}

    // Fills stores, data and sweeps of `plan`.
    void build(Plan& plan) {
        plan.data = plan_data(frame_, carrying_, schedule_, division_);
        make_stores();
        // Stores come first: the sweeps' steps refer to them, and keeping one is a root of a sweep.
        for (int s = 0; s < schedule_.sweeps(); ++s) plan.sweeps.push_back(make_sweep(s));
        plan.stores = std::move(stores_);
    }

private:
    const Op& op(int i) const { return frame_.ops[index(i)]; }
    const SweepWork& work(int sweep) const { return division_.work[index(sweep)]; }
    std::vector<RootNeed>& roots(int sweep) { return schedule_.roots[index(sweep)]; }

    void make_stores() {
        for (const auto& [value, found] : carrying_.found)
            if (!carrying_.held[found.held].is_datum) add_held_store(value, found.held);
        for (const auto& [value, span] : division_.kept) {
            Store store;
            store.values = {value};
            store.types = {SampleType::kFloat};  // no file says that fewer bits would do
            store.region = demand_.of(value);
            store.band_height = choices_.tile_height;  // a row of tiles fills one band
            store.first_sweep = span.made;
            store.last_sweep = span.last;
            store.carry_until = wanted_until(value);
            stores_.push_back(std::move(store));
        }
        for (int s = 0; s < schedule_.sweeps(); ++s)
            for (const ValueRef v : work(s).loads)
                if (op(v.op).source && !carrying_.is_found(v)) add_to_source_store(v, s);
        add_kept_roots();
    }

    // Planes stay in the order in which they lie there.
    void add_held_store(ValueRef v, std::size_t index) {
        const int held = static_cast<int>(index);
        const bool is_there = std::ranges::any_of(
            stores_, [&](const Store& s) { return s.held == held && s.values.front().op == v.op; });
        if (is_there) return;
        const Carried& from = carrying_.held[index];
        Store store;
        for (const ValueKey& key : from.keys) store.values.push_back({v.op, key.output});
        store.types = from.types;
        store.region = from.region;
        store.band_origin = from.band_origin;
        store.band_height = from.band_height;
        store.source_op = op(v.op).source ? v.op : -1;
        store.first_sweep = -1;
        store.last_sweep = schedule_.sweeps() - 1;
        store.held = held;
        stores_.push_back(std::move(store));
    }

    std::optional<int> wanted_until(ValueRef v) const {
        const auto it = carrying_.wanted.find(v);
        return it == carrying_.wanted.end() ? std::nullopt : std::optional(it->second.frame);
    }

    // A store holds a group of a source: all of it is carried for one of its channels.
    std::optional<int> wanted_until(int source, std::size_t group) const {
        std::optional<LastUse> last;
        for (const auto& [value, use] : carrying_.wanted)
            if (value.op == source && op(source).source_group[index(value.output)] == group)
                last = std::max(last, {use});
        return last ? std::optional(last->frame) : std::nullopt;
    }

    // A kept value is computed for its own sake in the sweep that makes it, over all that later ones read.
    void add_kept_roots() {
        for (std::size_t i = 0; i < stores_.size(); ++i) {
            if (stores_[i].source_op >= 0 || stores_[i].held >= 0) continue;
            RootNeed need;
            need.root.kind = Root::Kind::kKeep;
            need.root.store = static_cast<int>(i);
            need.root.op = stores_[i].values.front().op;
            need.root.region = stores_[i].region;
            need.values = stores_[i].values;
            roots(stores_[i].first_sweep).push_back(std::move(need));
        }
    }

    void add_to_source_store(ValueRef v, int sweep) {
        // One store a group, as its channels share chunks; where sources are not kept, one a sweep.
        const std::size_t output = static_cast<std::size_t>(v.output), group = op(v.op).source_group[output];
        auto it = std::ranges::find_if(stores_, [&](const Store& s) {
            return s.held < 0 && s.source_op == v.op && s.group == group &&
                   (choices_.keep_sources || s.carry_until || s.first_sweep == sweep);
        });
        if (it == stores_.end()) {
            const ChannelGroup& g = op(v.op).source->header().groups[group];
            Store store;
            store.source_op = v.op;
            store.group = group;
            // A band is a row of chunks: what is decoded together lives and dies together.
            store.band_origin = g.window.y0;
            store.band_height = g.chunk_height;
            store.first_sweep = sweep;
            store.carry_until = wanted_until(v.op, group);
            stores_.push_back(std::move(store));
            it = stores_.end() - 1;
        }
        it->last_sweep = it->carry_until ? schedule_.sweeps() : sweep;
        it->region = unite(it->region, demand_.of(v));
        if (std::ranges::find(it->values, v) != it->values.end()) return;
        it->values.push_back(v);
        it->types.push_back(*frame_.info(v).stored);
    }

    Sweep make_sweep(int s) {
        Sweep sweep;
        step_of_.clear();
        for (const ValueRef v : work(s).loads) add_load(sweep, v, s);
        // In the frame's order, in which each comes after what it reads.
        for (const int i : work(s).ops) add_compute(sweep, i);
        // The area is the hull of the roots; tiles are laid only where a root's region is.
        for (RootNeed& need : roots(s)) {
            for (const ValueRef v : need.values) need.root.operands.push_back(operand(v));
            if (need.root.kind == Root::Kind::kSink) mark_untouched(need, sweep);
            sweep.area = unite(sweep.area, need.root.region);
            sweep.roots.push_back(need.root);
        }
        for (std::size_t i = 0; i < stores_.size(); ++i)
            // A store that is read again in a later sweep is decoded here and only kept there.
            if (stores_[i].source_op >= 0 && stores_[i].first_sweep == s)
                sweep.reads.push_back(static_cast<int>(i));
        sweep.tile_width = choices_.tile_width;
        sweep.tile_height = choices_.tile_height;
        lay_grid(sweep);
        assign_slots(sweep);
        return sweep;
    }

    // Through the origin and not through the area's corner, so that a tile of one sweep is a tile of the
    // next: what it keeps for that is what that reads.
    static void lay_grid(Sweep& sweep) {
        std::vector<std::pair<int, int>> columns, rows;
        for (const Root& root : sweep.roots) {
            if (root.region.empty()) continue;
            const auto lines = [](int from, int to, int size) {
                return std::pair(floor_div(from, size), floor_div(to - 1, size) + 1);
            };
            columns.push_back(lines(root.region.x0, root.region.x1, sweep.tile_width));
            rows.push_back(lines(root.region.y0, root.region.y1, sweep.tile_height));
        }
        sweep.columns = counted_once(std::move(columns));
        sweep.rows = counted_once(std::move(rows));
    }

    // The numbers of half-open ranges, ascending.
    static std::vector<int> counted_once(std::vector<std::pair<int, int>> ranges) {
        std::ranges::sort(ranges);
        std::vector<int> out;
        for (const auto& [first, end] : ranges)
            for (int i = out.empty() ? first : std::max(first, out.back() + 1); i < end; ++i)
                out.push_back(i);
        return out;
    }

    // A channel that goes from file to file in one type is copied as bytes: no bit may change, not even of a
    // NaN, and a conversion to floats and back would only take time.
    void mark_untouched(RootNeed& need, const Sweep& sweep) const {
        const SinkSpec& spec = frame_.sinks[index(need.root.sink)].request.spec;
        for (std::size_t k = 0; k < need.values.size(); ++k) {
            const Operand& o = need.root.operands[k];
            const bool loaded = o.step >= 0 && sweep.steps[index(o.step)].kind == Step::Kind::kLoad;
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
            // Of several stores of one value, where sources are decoded again, the one of this sweep.
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
        step.op = i;
        for (int o = 0; o < static_cast<int>(op(i).outputs.size()); ++o)
            step.slots.push_back(demand_.of({i, o}).empty() ? Step::kUnwanted : 0);
        std::vector<Operand> operands;
        for (const Link& link : op(i).links)
            for (const ValueRef v : link.values) operands.push_back(operand(v));
        // try_emplace: an output that is loaded stays so, though another of the same operation is computed.
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
            for (const Operand& o : sweep.operands[i]) {
                assert(o.step < static_cast<int>(i) && "a step reads a slot that is written after it");
                if (o.step >= 0) last[index(o.step)] = i;
            }
        }
        // Roots run after all steps: what they take is never written over.
        for (const Root& r : sweep.roots)
            for (const Operand& o : r.operands)
                if (o.step >= 0) last[index(o.step)] = n;
        std::vector<int> free;  // the one freed last is the first to be used again: it is still in the cache
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
    const Carrying& carrying_;
    const Choices choices_;
    Schedule schedule_;
    const Division division_;
    std::vector<Store> stores_;
    std::map<ValueRef, Operand> step_of_;  // of the sweep being made
};

}  // namespace

void make_sweeps(Plan& plan, const Choices& choices) { SweepMaker(plan, choices).build(plan); }

}  // namespace keyline
