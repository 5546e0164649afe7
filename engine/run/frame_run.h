// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/index.h"
#include "engine/plan/plan.h"
#include "engine/run/sweep_run.h"
#include "engine/run/tiles.h"

#include <exception>
#include <memory>
#include <optional>
#include <vector>

namespace keyline {

// One frame on its way through its plan.  It hands out jobs and keeps the books; who runs them, on how many
// threads and in which order, changes no pixel.
//
// next() and completed() are for one thread at a time (the executor holds a lock); run() is for any number at
// once.
class FrameRun {
public:
    // Creates the outputs.  Throws Failure where one can't be made.  What the plan leaves for coming frames
    // is added to `left` once all of it is there; null: nobody wants it.
    explicit FrameRun(Plan plan, Recorder* recorder = nullptr,
                      std::shared_ptr<std::vector<Carried>> left = nullptr);
    ~FrameRun();

    // A job that is ready; nothing where all wait for jobs under way, or the frame is done.
    std::optional<Job> next();
    void run(const Job& job, TileWorker& worker);
    void completed(const Job& job);

    // A job threw; no more are handed out.  The error told is that of the earliest job among those that
    // threw.
    void failed(const Job& job, std::exception_ptr error);
    void cancel() { cancelled_ = true; }
    bool cancelled() const { return cancelled_; }

    // What the frame leaves is there: the next one can be planned.
    bool has_handed_on() const { return has_handed_on_; }

    // How much of it is done, by sweeps and their rows: 0 to 1, never less than before.
    double part() const;

    // No job is left and none is under way.
    bool done() const;
    std::exception_ptr error() const { return error_; }

    const Plan& plan() const { return plan_; }
    // What there is to warn of once the frame is done.
    std::vector<Error> warnings() const;

private:
    void start_sweep();
    void end_sweep(int worker);
    void create_sinks();
    const Op& op(int i) const { return plan_.frame.ops[index(i)]; }

    void take_held();
    bool can_hand_on() const;
    void hand_on();
    std::vector<std::string> findings_of(std::size_t i) const;

    void make_data(int sweep, int worker);
    std::shared_ptr<const Datum> made(int i);
    Timed timed(Activity activity, const std::string& title, int worker) const;
    void finish_sink(std::size_t i, int worker);

    Plan plan_;
    FrameState state_;
    std::shared_ptr<std::vector<Carried>> left_;
    bool has_handed_on_ = false;
    std::vector<std::unique_ptr<ImageSink>> sinks_;      // null: one of data
    std::vector<std::unique_ptr<DataSink>> data_sinks_;  // null: one of pixels
    std::vector<std::size_t> overflowed_;                // by sink
    bool begun_ = false;                                 // the data that the first sweep needs are made
    std::unique_ptr<SweepRun> sweep_;
    std::size_t sweep_index_ = 0;
    std::size_t next_finish_ = 0;  // sinks finished so far
    int under_way_ = 0;
    bool cancelled_ = false;
    std::exception_ptr error_;
    std::optional<Job> error_job_;
};

}  // namespace keyline
