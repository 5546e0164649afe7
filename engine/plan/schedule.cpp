// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/plan/schedule.h"

#include "engine/base/index.h"

#include <algorithm>

namespace keyline {

namespace {

class Scheduler {
public:
    Scheduler(const ResolvedFrame& frame, const Carrying& carrying) : frame_(frame), carrying_(carrying) {}

    Schedule run() {
        find_availability();
        for (std::size_t i = 0; i < frame_.ops.size(); ++i)
            if (frame_.ops[i].gather && carrying_.needed[i]) add_gather(static_cast<int>(i));
        for (std::size_t i = 0; i < frame_.sinks.size(); ++i)
            if (!frame_.sinks[i].request.stream.is_data()) add_sink(static_cast<int>(i));
        return std::move(schedule_);
    }

private:
    int available(ValueRef v) const { return v.op < 0 ? 0 : schedule_.available[index(v.op)]; }

    // Each as early as may be, so that as few sweeps as possible go over the frame.
    //
    // A gather's datum exists a sweep a round after its inputs do.  Everything else is made in the sweep, or
    // just before the sweep, in which the last of its inputs comes to be.
    void find_availability() {
        for (std::size_t i = 0; i < frame_.ops.size(); ++i) {
            const Op& op = frame_.ops[i];
            if (!carrying_.needed[i]) {
                schedule_.available.push_back(0);
                continue;
            }
            int ready = 0;
            for (const Link& link : op.links) {
                ready = std::max(ready, available(link.datum));
                for (const ValueRef v : link.values) ready = std::max(ready, available(v));
            }
            schedule_.available.push_back(ready + (op.gather ? op.gather->rounds() : 0));
        }
    }

    void add_gather(int i) {
        RootNeed need;
        need.root.kind = Root::Kind::kMap;
        need.root.op = i;
        for (const Link& link : frame_.ops[index(i)].links) {
            need.root.region = unite(need.root.region, link.extent);
            need.values.insert(need.values.end(), link.values.begin(), link.values.end());
        }
        // A round is a sweep of its own: map() may look at what all tiles made of the round before.
        const int end = schedule_.available[index(i)];
        for (int sweep = schedule_.first_sweep_of_gather(frame_, i); sweep < end; ++sweep)
            roots_at(sweep).push_back(need);
    }

    void add_sink(int i) {
        const Stream& stream = frame_.sinks[index(i)].request.stream;
        RootNeed need;
        need.root.kind = Root::Kind::kSink;
        need.root.sink = i;
        need.root.region = stream.window;
        // All channels in one sweep, as a file's chunks hold them all: the one that comes last decides.
        int sweep = 0;
        for (const StreamChannel& c : stream.channels) {
            need.values.push_back(c.value);
            sweep = std::max(sweep, available(c.value));
        }
        roots_at(sweep).push_back(std::move(need));
    }

    std::vector<RootNeed>& roots_at(int sweep) {
        if (schedule_.sweeps() <= sweep) schedule_.roots.resize(static_cast<std::size_t>(sweep) + 1);
        return schedule_.roots[index(sweep)];
    }

    const ResolvedFrame& frame_;
    const Carrying& carrying_;
    Schedule schedule_;
};

}  // namespace

Schedule make_schedule(const ResolvedFrame& frame, const Carrying& carrying) {
    return Scheduler(frame, carrying).run();
}

}  // namespace keyline
