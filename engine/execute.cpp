// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/execute.h"

#include <list>
#include <mutex>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

namespace keyline {

namespace {

constexpr std::size_t kFramesAtOnce = 2;  // one that is finishing, one that is being read

// The frames at work: each job that ends hands out those that became ready, of the oldest frame first.
class Pool {
public:
    Pool(FrameSupply& supply, std::vector<std::unique_ptr<TileWorker>>& workers, std::size_t memory,
         const std::atomic<bool>& cancel)
        : supply_(supply), memory_(memory), cancel_(cancel) {
        for (const auto& w : workers) idle_.push_back(w.get());
    }

    void run() {
        {
            const std::lock_guard lock(mutex_);
            dispatch();
        }
        group_.wait();
    }

private:
    using Frames = std::list<std::unique_ptr<FrameRun>>;

    // Under the lock.
    void dispatch() {
        end_frames();
        for (const auto& frame : frames_) {
            if (cancel_) frame->cancel();
            start_jobs(*frame);
        }
        if (wants_frame()) start_next_frame();
        end_frames();
    }

    void start_jobs(FrameRun& frame) {
        while (!idle_.empty()) {
            const std::optional<Job> job = frame.next();
            if (!job) return;
            TileWorker* worker = take_worker();
            group_.run([this, &frame, job = *job, worker] { work(frame, job, worker); });
        }
    }

    bool wants_frame() const {
        if (exhausted_ || opening_ || cancel_ || idle_.empty() || frames_.size() >= kFramesAtOnce)
            return false;
        // The next frame will want about what this one does.
        return frames_.empty() || memory_ == 0 || 2 * frames_.back()->plan().memory_bytes <= memory_;
    }

    void start_next_frame() {
        opening_ = true;
        TileWorker* worker = take_worker();
        group_.run([this, worker] {
            auto frame = supply_.next();
            const std::lock_guard lock(mutex_);
            opening_ = false;
            if (frame)
                frames_.push_back(std::move(frame));
            else
                exhausted_ = true;
            idle_.push_back(worker);
            dispatch();
        });
    }

    void work(FrameRun& frame, const Job& job, TileWorker* worker) {
        std::exception_ptr error;
        try {
            frame.run(job, *worker);
        } catch (...) {
            error = std::current_exception();
        }
        const std::lock_guard lock(mutex_);
        if (error)
            frame.failed(job, error);
        else
            frame.completed(job);
        idle_.push_back(worker);
        dispatch();
    }

    // The oldest first, and not while the supply is busy with the next frame: its calls come one at a time.
    void end_frames() {
        while (!opening_ && !frames_.empty() && frames_.front()->done()) {
            if (!frames_.front()->cancelled() && !supply_.ended(*frames_.front())) give_up();
            frames_.pop_front();
        }
    }

    void give_up() {
        exhausted_ = true;
        for (const auto& frame : frames_)
            if (!frame->done()) frame->cancel();
    }

    TileWorker* take_worker() {
        TileWorker* worker = idle_.back();
        idle_.pop_back();
        return worker;
    }

    FrameSupply& supply_;
    const std::size_t memory_;
    const std::atomic<bool>& cancel_;
    std::mutex mutex_;
    std::vector<TileWorker*> idle_;
    Frames frames_;  // oldest first
    bool opening_ = false, exhausted_ = false;
    tbb::task_group group_;
};

// One frame, whose error is kept.
class SingleFrame final : public FrameSupply {
public:
    explicit SingleFrame(std::unique_ptr<FrameRun> frame) : frame_(std::move(frame)) {}
    std::unique_ptr<FrameRun> next() override { return std::move(frame_); }
    bool ended(const FrameRun& frame) override {
        error_ = frame.error();
        return true;
    }
    std::exception_ptr error() const { return error_; }

private:
    std::unique_ptr<FrameRun> frame_;
    std::exception_ptr error_;
};

}  // namespace

Executor::Executor(int threads, std::size_t memory) : threads_(threads), memory_(memory) {
    for (int i = 0; i < threads; ++i) workers_.push_back(std::make_unique<TileWorker>(i));
}

void Executor::run(FrameSupply& supply, const std::atomic<bool>& cancel) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads_));
    tbb::task_arena arena(threads_);
    arena.execute([&] { Pool(supply, workers_, memory_, cancel).run(); });
    if (cancel) fail(ErrorKind::kCancelled, "cancelled");
}

void Executor::run(std::unique_ptr<FrameRun> frame, const std::atomic<bool>& cancel) {
    SingleFrame supply(std::move(frame));
    run(supply, cancel);
    if (supply.error()) std::rethrow_exception(supply.error());
}

}  // namespace keyline
