// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/plan/kept.h"

#include "engine/base/index.h"

#include <algorithm>

namespace keyline {

namespace {

class Divider {
public:
    Divider(const ResolvedFrame& frame, const Demand& demand, const Carrying& carrying,
            const Schedule& schedule)
        : frame_(frame), demand_(demand), carrying_(carrying), schedule_(schedule) {}

    Division run(bool keep) {
        if (keep) choose_kept();
        keep_wanted();
        // Only now: what a late sweep keeps of the first, those between have from the store too.
        for (int s = 0; s < schedule_.sweeps(); ++s) {
            division_.work.push_back(work_of(s));
            for (auto& [value, span] : division_.kept)
                if (division_.work.back().loads.contains(value)) span.last = std::max(span.last, s);
        }
        return std::move(division_);
    }

private:
    const Op& op(int i) const { return frame_.ops[index(i)]; }
    const std::vector<RootNeed>& roots(int sweep) const { return schedule_.roots[index(sweep)]; }

    // Whether a sweep reads a value from a store rather than computing it.
    bool is_stored(ValueRef v, int sweep) const {
        if (op(v.op).source || carrying_.is_found(v)) return true;
        const auto it = division_.kept.find(v);
        return it != division_.kept.end() && it->second.made < sweep;
    }

    // From the roots of the sweep backward.
    SweepWork work_of(int sweep) const {
        SweepWork work;
        std::vector<ValueRef> open;
        for (const RootNeed& r : roots(sweep)) open.insert(open.end(), r.values.begin(), r.values.end());
        while (!open.empty()) {
            const ValueRef v = open.back();
            open.pop_back();
            if (demand_.of(v).empty()) continue;  // 0 wherever it is looked at
            if (is_stored(v, sweep)) {
                work.loads.insert(v);
            } else if (work.ops.insert(v.op).second) {
                // A datum that it reads was made between sweeps: only pixels are followed.
                for (const Link& link : op(v.op).links)
                    open.insert(open.end(), link.values.begin(), link.values.end());
            }
        }
        return work;
    }

    // A result is kept for a later sweep where computing it again would run a stencil: point operations on
    // what is stored, or on data, cost less than the memory.
    void choose_kept() {
        std::map<int, int> computed_in;  // operation → the first sweep that computes it
        for (int s = 0; s < schedule_.sweeps(); ++s) {
            const SweepWork work = work_of(s);
            for (const int i : work.ops) computed_in.emplace(i, s);
            keep_frontier(s, work, computed_in);
        }
    }

    // Until the frame ends, as far as it knows.
    void keep_wanted() {
        if (carrying_.wanted.empty()) return;
        std::map<int, int> computed_in;
        for (int s = 0; s < schedule_.sweeps(); ++s)
            for (const int i : work_of(s).ops) computed_in.emplace(i, s);
        for (const auto& [value, until] : carrying_.wanted)
            if (const auto it = computed_in.find(value.op); it != computed_in.end())
                division_.kept.try_emplace(value, Division::Span{it->second, it->second}).first->second.last =
                    schedule_.sweeps();
    }

    // The values between what this sweep is the first to compute and what an earlier one has computed
    // already: keeping any others would save nothing more.
    void keep_frontier(int sweep, const SweepWork& work, const std::map<int, int>& computed_in) {
        const auto earlier = [&](int i) {
            const auto it = computed_in.find(i);
            return it != computed_in.end() && it->second < sweep;
        };
        const auto consider = [&](ValueRef v) {
            if (op(v.op).source || is_stored(v, sweep) || !work.ops.contains(v.op) || !earlier(v.op)) return;
            if (runs_stencil(v, sweep))
                division_.kept.try_emplace(v, Division::Span{computed_in.at(v.op), sweep});
        };
        for (const RootNeed& r : roots(sweep))
            for (const ValueRef v : r.values) consider(v);
        for (const int i : work.ops) {
            if (earlier(i)) continue;
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
            if (is_stored(next, sweep) || !seen.insert(next.op).second) continue;
            if (!op(next.op).operation->point()) return true;
            for (const Link& link : op(next.op).links)
                open.insert(open.end(), link.values.begin(), link.values.end());
        }
        return false;
    }

    const ResolvedFrame& frame_;
    const Demand& demand_;
    const Carrying& carrying_;
    const Schedule& schedule_;
    Division division_;
};

}  // namespace

Division divide_work(const ResolvedFrame& frame, const Demand& demand, const Carrying& carrying,
                     const Schedule& schedule, bool keep) {
    return Divider(frame, demand, carrying, schedule).run(keep);
}

}  // namespace keyline
