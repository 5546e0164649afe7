// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/frame_run.h"

#include <algorithm>
#include <fmt/format.h>

namespace keyline {

namespace {

// Null data anywhere: not resident.
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

FrameRun::FrameRun(Plan plan, Recorder* recorder) : plan_(std::move(plan)) {
    data_.recorder = recorder;
    create_sinks();
    data_.stores.resize(plan_.stores.size());
    data_.reductions.resize(plan_.frame.ops.size());
    for (std::size_t i = 0; i < plan_.frame.ops.size(); ++i) {
        const Op& op = plan_.frame.ops[i];
        const Reduction* r = op.operation ? op.operation->reduction() : nullptr;
        if (r && plan_.demand.needs(i)) data_.reductions[i] = r->start(op.outputs.front().window);
    }
    start_sweep();
}

FrameRun::~FrameRun() = default;

void FrameRun::create_sinks() {
    overflowed_.resize(plan_.frame.sinks.size(), 0);
    for (const Sink& sink : plan_.frame.sinks) {
        naming(sink.title, plan_.frame.frame,
               [&] { sinks_.push_back(sink.request.create(sink.request.spec)); });
        const ImageSink& s = *sinks_.back();
        data_.sinks.push_back(sink_bands(s));
    }
}

void FrameRun::start_sweep() {
    for (std::size_t i = 0; i < plan_.stores.size(); ++i) {
        const Store& store = plan_.stores[i];
        if (store.first_sweep == static_cast<int>(sweep_index_)) data_.stores[i] = store_bands(plan_, store);
    }
    sweep_ = std::make_unique<SweepRun>(plan_, static_cast<int>(sweep_index_), data_, sinks_);
}

// Ends a round of each whole-frame node mapped, and drops what no later sweep uses.
void FrameRun::end_sweep() {
    const Sweep& sweep = plan_.sweeps[sweep_index_];
    for (const Root& root : sweep.roots) {
        if (root.kind == Root::Kind::kSink) data_.sinks[static_cast<std::size_t>(root.sink)].reset();
        if (root.kind == Root::Kind::kMap)
            plan_.frame.ops[static_cast<std::size_t>(root.op)].operation->reduction()->finish(
                *data_.reductions[static_cast<std::size_t>(root.op)]);
    }
    for (std::size_t i = 0; i < plan_.stores.size(); ++i)
        if (plan_.stores[i].last_sweep == static_cast<int>(sweep_index_)) data_.stores[i].reset();
    for (std::size_t i = 0; i < overflowed_.size(); ++i) overflowed_[i] += sweep_->overflowed()[i];
}

std::optional<Job> FrameRun::next() {
    if (error_ || cancelled_) return std::nullopt;
    std::optional<Job> job;
    if (sweep_) {
        job = sweep_->next();
        if (!job && under_way_ == 0 && sweep_->done()) job = Job{Job::Kind::kEndSweep, 0, 0, 0};
    } else if (next_finish_ < sinks_.size()) {
        job = Job{Job::Kind::kFinish, static_cast<int>(next_finish_++), 0, 0};
    }
    if (job) ++under_way_;
    return job;
}

void FrameRun::run(const Job& job, TileWorker& worker) {
    const int frame = plan_.frame.frame, sweep = static_cast<int>(sweep_index_);
    if (job.kind == Job::Kind::kEndSweep) {
        const Timed time(data_.recorder, Activity::kEndSweep, "whole-frame nodes", frame, sweep, worker.id());
        end_sweep();
    } else if (job.kind == Job::Kind::kFinish) {
        const auto sink = static_cast<std::size_t>(job.which);
        const Timed time(data_.recorder, Activity::kFinish, plan_.frame.sinks[sink].title, frame, sweep,
                         worker.id());
        naming(plan_.frame.sinks[sink].title, frame, [&] { sinks_[sink]->finish(); });
    } else {
        sweep_->run(job, worker);
    }
}

void FrameRun::completed(const Job& job) {
    --under_way_;
    if (job.kind == Job::Kind::kEndSweep) {
        sweep_.reset();
        if (++sweep_index_ < plan_.sweeps.size()) start_sweep();
    } else if (sweep_) {
        sweep_->completed(job);
    }
}

void FrameRun::failed(const Job& job, std::exception_ptr error) {
    --under_way_;
    if (error_job_ && *error_job_ < job) return;
    error_ = std::move(error);
    error_job_ = job;
}

bool FrameRun::done() const {
    if (under_way_ > 0) return false;
    return error_ || cancelled_ || (!sweep_ && next_finish_ == sinks_.size());
}

std::vector<Error> FrameRun::warnings() const {
    std::vector<Error> out;
    for (const Op& op : plan_.frame.ops) {
        if (!op.source) continue;
        for (std::string& what : op.source->findings())
            out.push_back({ErrorKind::kFailed,
                           {},
                           fmt::format("{}, frame {}", op.title, op.frame),
                           op.source->header().file.string() + ": " + what,
                           {}});
    }
    for (std::size_t i = 0; i < overflowed_.size(); ++i) {
        if (overflowed_[i] == 0) continue;
        out.push_back({ErrorKind::kFailed,
                       {},
                       fmt::format("{}, frame {}", plan_.frame.sinks[i].title, plan_.frame.frame),
                       fmt::format("{} value{} beyond half's range became infinity", overflowed_[i],
                                   overflowed_[i] == 1 ? "" : "s"),
                       "write with \"depth\": \"float\" to keep them"});
    }
    return out;
}

}  // namespace keyline
