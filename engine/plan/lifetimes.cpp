// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/plan/lifetimes.h"

#include "engine/base/index.h"

#include <algorithm>

namespace keyline {

namespace {

class DataPlanner {
public:
    DataPlanner(const ResolvedFrame& frame, const Carrying& carrying, const Schedule& schedule,
                const Division& division)
        : frame_(frame), carrying_(carrying), schedule_(schedule), division_(division) {
        for (std::size_t i = 0; i < frame.ops.size(); ++i) data_.push_back(planned(static_cast<int>(i)));
    }

    std::vector<PlannedDatum> run() {
        for (int s = 0; s < schedule_.sweeps(); ++s) read_by_sweep(s);
        for (const Sink& sink : frame_.sinks)
            read(sink.request.stream.datum, schedule_.sweeps(), schedule_.sweeps());
        // Backward: who derives is settled before what it derives from.
        for (std::size_t i = frame_.ops.size(); i-- > 0;)
            if (frame_.ops[i].derivation && carrying_.needed[i]) read_by_derivation(i);
        std::vector<PlannedDatum> out;
        for (std::size_t i = 0; i < frame_.ops.size(); ++i) {
            if (!frame_.ops[i].makes_data()) continue;
            const bool is_read = first_read_.contains(static_cast<int>(i));
            if (carrying_.needed[i] || (data_[i].held >= 0 && is_read)) out.push_back(data_[i]);
        }
        return out;
    }

private:
    PlannedDatum planned(int i) const {
        const Op& op = frame_.ops[index(i)];
        PlannedDatum datum;
        datum.op = i;
        datum.made_before = schedule_.available[index(i)];
        if (const auto it = carrying_.found.find({i, 0}); it != carrying_.found.end()) {
            datum.held = static_cast<int>(it->second.held);
            datum.made_before = -1;
        }
        datum.last_sweep = datum.made_before - 1;  // nobody yet
        if (op.gather) datum.bytes = op.gather->datum_bytes(op.outputs.front().window);
        if (op.derivation) datum.bytes = op.derivation->datum_bytes();
        if (const auto it = carrying_.wanted.find({i, 0}); op.makes_data() && it != carrying_.wanted.end()) {
            datum.carry_until = it->second.frame;
            datum.last_sweep = schedule_.sweeps();
        }
        return datum;
    }

    // Whoever reads it needs it made before sweep `first`, and until sweep `last` has ended.
    void read(ValueRef v, int first, int last) {
        if (v.op < 0) return;
        PlannedDatum& datum = data_[index(v.op)];
        datum.last_sweep = std::max(datum.last_sweep, last);
        int& known = first_read_.try_emplace(v.op, first).first->second;
        known = std::min(known, first);
    }

    void read_by_sweep(int s) {
        const auto read_by = [&](int op) {
            for (const Link& link : frame_.ops[index(op)].links) read(link.datum, s, s);
        };
        for (const RootNeed& need : schedule_.roots[index(s)])
            if (need.root.kind == Root::Kind::kMap) read_by(need.root.op);
        for (const int op : division_.work[index(s)].ops) read_by(op);
    }

    // A datum that waits for no sweep (a source, or derived from sources) is made as late as it may be: until
    // then it takes no memory.  One that waits is made at once, so that what it derives from can go.
    void read_by_derivation(std::size_t i) {
        PlannedDatum& datum = data_[i];
        // Nobody of this frame reads what only coming ones want.
        if (const auto it = first_read_.find(static_cast<int>(i));
            schedule_.available[i] == 0 && it != first_read_.end())
            datum.made_before = it->second;
        // What is made before a sweep is made while the one before that ends.
        for (const Link& link : frame_.ops[i].links)
            read(link.datum, datum.made_before, datum.made_before - 1);
    }

    const ResolvedFrame& frame_;
    const Carrying& carrying_;
    const Schedule& schedule_;
    const Division& division_;
    std::vector<PlannedDatum> data_;  // by operation
    std::map<int, int> first_read_;   // by operation: the sweep
};

}  // namespace

std::vector<PlannedDatum> plan_data(const ResolvedFrame& frame, const Carrying& carrying,
                                    const Schedule& schedule, const Division& division) {
    return DataPlanner(frame, carrying, schedule, division).run();
}

}  // namespace keyline
