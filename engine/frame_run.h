// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/plan.h"
#include "engine/sweep_run.h"
#include "engine/tiles.h"

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
    // Creates the outputs.  Throws Failure where one can't be made.
    explicit FrameRun(Plan plan, Recorder* recorder = nullptr);
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

    // No job is left and none is under way.
    bool done() const;
    std::exception_ptr error() const { return error_; }

    const Plan& plan() const { return plan_; }
    // What there is to warn of once the frame is done.
    std::vector<Error> warnings() const;

private:
    void start_sweep();
    void end_sweep();
    void create_sinks();

    Plan plan_;
    FrameData data_;
    std::vector<std::unique_ptr<ImageSink>> sinks_;
    std::vector<std::size_t> overflowed_;  // by sink
    std::unique_ptr<SweepRun> sweep_;
    std::size_t sweep_index_ = 0;
    std::size_t next_finish_ = 0;  // sinks finished so far
    int under_way_ = 0;
    bool cancelled_ = false;
    std::exception_ptr error_;
    std::optional<Job> error_job_;
};

}  // namespace keyline
