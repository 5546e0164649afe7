// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/run/frame_run.h"

#include "engine/base/index.h"

#include <algorithm>
#include <fmt/format.h>

namespace keyline {

namespace {

// A source or sink that lies in memory is read and filled where it is.  Null data anywhere: it does not.
bool is_resident(const std::vector<Plane>& planes) {
    return !planes.empty() && std::ranges::all_of(planes, [](const Plane& p) { return p.data != nullptr; });
}

std::unique_ptr<Bands> sink_bands(const ImageSink& sink) {
    std::vector<Plane> planes;
    std::vector<SampleType> types;
    for (const ChannelInfo& c : sink.channels()) {
        planes.push_back(sink.resident(types.size()));
        types.push_back(c.type);
    }
    const Rect region = sink.region();
    if (is_resident(planes))
        return std::make_unique<Bands>(region, std::move(planes), region.y0, sink.chunk_height());
    return std::make_unique<Bands>(region, std::move(types), region.y0, sink.chunk_height());
}

std::unique_ptr<Bands> store_bands(const Plan& plan, const Store& store) {
    std::vector<Plane> planes;
    for (const ValueRef v : store.values) planes.push_back(resident_plane(plan.frame, v));
    if (is_resident(planes))
        return std::make_unique<Bands>(store.region, std::move(planes), store.band_origin, store.band_height);
    return std::make_unique<Bands>(store.region, store.types, store.band_origin, store.band_height,
                                   store.first_sweep < store.last_sweep);
}

}  // namespace

FrameRun::FrameRun(Plan plan, Recorder* recorder, std::shared_ptr<std::vector<Carried>> left)
    : plan_(std::move(plan)), left_(std::move(left)) {
    state_.recorder = recorder;
    create_sinks();
    state_.stores.resize(plan_.stores.size());
    state_.gathering.resize(plan_.frame.ops.size());
    state_.data.resize(plan_.frame.ops.size());
    take_held();
    // Files of data are read by a job, like pixels, and not by the thread that opens frames.
    begun_ = std::ranges::none_of(plan_.data, [](const PlannedDatum& d) { return d.made_before == 0; });
    if (begun_) start_sweep();
    hand_on();
}

// The sources may stay open for other frames: what they decode in belongs to this one.
FrameRun::~FrameRun() {
    for (const Op& op : plan_.frame.ops)
        if (op.source) op.source->rest();
}

// What an earlier frame left stands in its place before the first job asks for it.
void FrameRun::take_held() {
    for (std::size_t i = 0; i < plan_.stores.size(); ++i)
        if (const int held = plan_.stores[i].held; held >= 0)
            state_.stores[i] = plan_.carrying.held[index(held)].bands;
    for (const PlannedDatum& d : plan_.data)
        if (d.held >= 0) state_.data[index(d.op)] = plan_.carrying.held[index(d.held)].datum;
    // The run has what coming frames want; it need not stay for this one to end.
    for (Carried& h : plan_.carrying.held) {
        h.bands.reset();
        h.datum.reset();
    }
}

// Whole: no row of tiles waits for it any more, and it is written by nobody.
bool FrameRun::can_hand_on() const {
    const int now = static_cast<int>(sweep_index_);
    const bool has_decoded = sweep_ && sweep_->has_decoded_all();
    return begun_ &&
           std::ranges::all_of(plan_.stores,
                               [&](const Store& s) {
                                   return !s.carry_until || s.first_sweep < now ||
                                          (s.first_sweep == now && s.source_op >= 0 && has_decoded);
                               }) &&
           std::ranges::all_of(plan_.data,
                               [&](const PlannedDatum& d) { return !d.carry_until || d.made_before <= now; });
}

// All at once: of a frame that fails before, nothing is left.
void FrameRun::hand_on() {
    if (has_handed_on_ || !can_hand_on()) return;
    has_handed_on_ = true;
    if (!left_) return;
    for (Carried& held : to_hand_on(plan_)) {
        const auto made_as = static_cast<std::size_t>(held.made_as);
        if (held.is_datum)
            held.datum = state_.data[made_as];
        else
            held.bands = state_.stores[made_as];
        left_->push_back(std::move(held));
    }
}

void FrameRun::create_sinks() {
    overflowed_.resize(plan_.frame.sinks.size(), 0);
    for (const Sink& sink : plan_.frame.sinks) {
        const SinkRequest& request = sink.request;
        const bool is_data = request.stream.is_data();
        naming(sink.title, plan_.frame.frame, [&] {
            sinks_.push_back(is_data ? nullptr : request.create(request.spec));
            data_sinks_.push_back(is_data ? request.create_for_data() : nullptr);
        });
        state_.sinks.push_back(is_data ? nullptr : sink_bands(*sinks_.back()));
    }
}

void FrameRun::start_sweep() {
    if (sweep_index_ == plan_.sweeps.size()) return;
    // Stores and states are made when the first who fills them comes: an earlier sweep has the memory for
    // itself.
    for (std::size_t i = 0; i < plan_.stores.size(); ++i) {
        const Store& store = plan_.stores[i];
        if (store.first_sweep == static_cast<int>(sweep_index_)) state_.stores[i] = store_bands(plan_, store);
    }
    // A gather of several rounds goes on with the state that it has.
    for (const Root& root : plan_.sweeps[sweep_index_].roots) {
        if (root.kind != Root::Kind::kMap) continue;
        std::unique_ptr<Gather::State>& gathering = state_.gathering[index(root.op)];
        if (!gathering) gathering = op(root.op).gather->start(op(root.op).outputs.front().window);
    }
    sweep_ = std::make_unique<SweepRun>(plan_, static_cast<int>(sweep_index_), state_, sinks_);
}

// Ends a round of the gathers that have more to come, and drops what no later sweep uses.
void FrameRun::end_sweep(int worker) {
    const int next = static_cast<int>(sweep_index_) + 1;
    const auto goes_on = [&](int op) {
        return std::ranges::any_of(plan_.data,
                                   [&](const PlannedDatum& d) { return d.op == op && d.made_before > next; });
    };
    for (const Root& root : plan_.sweeps[sweep_index_].roots) {
        if (root.kind == Root::Kind::kSink) state_.sinks[index(root.sink)].reset();
        if (root.kind != Root::Kind::kMap || !goes_on(root.op)) continue;
        const Timed time = timed(Activity::kMakeData, op(root.op).title, worker);
        op(root.op).gather->end_round(*state_.gathering[index(root.op)]);
    }
    // Before data are made: what the sweep needed and what they take never stand beside each other.
    for (std::size_t i = 0; i < plan_.stores.size(); ++i)
        if (plan_.stores[i].last_sweep == static_cast<int>(sweep_index_)) state_.stores[i].reset();
    for (std::size_t i = 0; i < overflowed_.size(); ++i) overflowed_[i] += sweep_->overflowed()[i];
}

// The data that there are before a sweep: of gathers that the one before it ended, then what derives from
// them.  One after the other, in the frame's order, so that each finds what it derives from.
void FrameRun::make_data(int sweep, int worker) {
    for (const PlannedDatum& d : plan_.data) {
        if (d.made_before != sweep) continue;
        Timed time = timed(Activity::kMakeData, op(d.op).title, worker);
        try {
            state_.data[index(d.op)] = made(d.op);
        } catch (...) {
            rethrow_of(op(d.op), "between two sweeps");
        }
        time.bytes(static_cast<int64_t>(state_.data[index(d.op)]->bytes()));
    }
    for (const PlannedDatum& d : plan_.data)
        if (d.last_sweep < sweep) state_.data[index(d.op)].reset();
}

std::shared_ptr<const Datum> FrameRun::made(int i) {
    if (op(i).gather) {
        // Taken out, so that it goes with this function: only the datum stays.
        const auto state = std::move(state_.gathering[index(i)]);
        return op(i).gather->finish(*state);
    }
    std::vector<const Datum*> data;
    collect_data(op(i), state_, data);
    return op(i).derivation->derive(Inputs({}, {}, data));
}

Timed FrameRun::timed(Activity activity, const std::string& title, int worker) const {
    // What comes after the last sweep is told with that.
    const std::size_t sweeps = plan_.sweeps.size(),
                      sweep = std::min(sweep_index_, sweeps - (sweeps > 0 ? 1 : 0));
    return {state_.recorder, activity, title, plan_.frame.frame, static_cast<int>(sweep), worker};
}

// A job by itself: to sync a file takes long, and other files and the next frame need not wait for it.
void FrameRun::finish_sink(std::size_t i, int worker) {
    const Sink& sink = plan_.frame.sinks[i];
    const Timed time = timed(Activity::kFinish, sink.title, worker);
    naming(sink.title, plan_.frame.frame, [&] {
        if (sinks_[i]) return sinks_[i]->finish();
        data_sinks_[i]->write(state_.data[index(sink.request.stream.datum.op)]);
    });
}

std::optional<Job> FrameRun::next() {
    // What is under way ends by itself; nothing new is begun.
    if (error_ || cancelled_) return std::nullopt;
    std::optional<Job> job;
    if (!begun_) {
        if (under_way_ == 0) job = Job{Job::Kind::kBegin, 0, 0, 0};
    } else if (sweep_) {
        job = sweep_->next();
        // Alone: nobody may look at states and stores while the sweep ends.
        if (!job && under_way_ == 0 && sweep_->done()) job = Job{Job::Kind::kEndSweep, 0, 0, 0};
    } else if (next_finish_ < sinks_.size()) {
        job = Job{Job::Kind::kFinish, static_cast<int>(next_finish_++), 0, 0};
    }
    if (job) ++under_way_;
    return job;
}

void FrameRun::run(const Job& job, TileWorker& worker) {
    switch (job.kind) {
        case Job::Kind::kBegin: return make_data(0, worker.id());
        case Job::Kind::kEndSweep:
            end_sweep(worker.id());
            return make_data(static_cast<int>(sweep_index_) + 1, worker.id());
        case Job::Kind::kFinish: return finish_sink(static_cast<std::size_t>(job.which), worker.id());
        default: return sweep_->run(job, worker);
    }
}

void FrameRun::completed(const Job& job) {
    --under_way_;
    if (job.kind == Job::Kind::kBegin) {
        begun_ = true;
        start_sweep();
    } else if (job.kind == Job::Kind::kEndSweep) {
        sweep_.reset();
        ++sweep_index_;
        start_sweep();
    } else if (sweep_) {
        sweep_->completed(job);
    }
    hand_on();
}

void FrameRun::failed(const Job& job, std::exception_ptr error) {
    --under_way_;
    // Which of several errors comes first depends on the threads; which job is the earliest does not.
    if (error_job_ && *error_job_ < job) return;
    error_ = std::move(error);
    error_job_ = job;
}

bool FrameRun::done() const {
    if (under_way_ > 0) return false;
    return error_ || cancelled_ || (begun_ && !sweep_ && next_finish_ == sinks_.size());
}

double FrameRun::part() const {
    if (plan_.sweeps.empty()) return 0;
    const double of_sweep = sweep_ ? sweep_->part() : 0;
    return (static_cast<double>(sweep_index_) + of_sweep) / static_cast<double>(plan_.sweeps.size());
}

// Of an operation that an earlier frame ran for this one, what it found there.
std::vector<std::string> FrameRun::findings_of(std::size_t i) const {
    const Op& op = plan_.frame.ops[i];
    if (op.source) return op.source->findings(plan_.demand.regions[i]);
    if (!op.operation) return {};
    if (plan_.demand.needs(i) && !plan_.carrying.needed[i])
        for (const Carried& held : plan_.carrying.held)
            for (const Carried::Behind& behind : held.behind)
                if (behind.digest == op.digest) return behind.operation->findings();
    return op.operation->findings();
}

std::vector<Error> FrameRun::warnings() const {
    std::vector<Error> out;
    for (std::size_t i = 0; i < plan_.frame.ops.size(); ++i) {
        const Op& op = plan_.frame.ops[i];
        const std::string file = op.source ? op.source->header().file.string() + ": " : "";
        for (const std::string& what : findings_of(i))
            out.push_back({ErrorKind::kFailed,
                           op.place,
                           fmt::format("{}, frame {}", op.title, op.frame),
                           file + what,
                           {}});
    }
    for (std::size_t i = 0; i < overflowed_.size(); ++i) {
        if (overflowed_[i] == 0) continue;
        out.push_back({ErrorKind::kFailed, plan_.frame.sinks[i].place,
                       fmt::format("{}, frame {}", plan_.frame.sinks[i].title, plan_.frame.frame),
                       fmt::format("{} value{} beyond half's range became infinity", overflowed_[i],
                                   overflowed_[i] == 1 ? "" : "s"),
                       "write with \"depth\": \"float\" to keep them"});
    }
    return out;
}

}  // namespace keyline
