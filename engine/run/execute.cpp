// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/run/execute.h"

#include <list>
#include <mutex>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

namespace keyline {

namespace {

constexpr std::size_t kFramesAtOnce = 2;  // one that is finishing, one that is being read

// The frames at work: a worker that has done a job hands out those that became ready, and takes one itself.
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

    struct Task {
        FrameRun* frame;  // null: begin the next frame
        Job job;
    };

    // Under the lock: gives idle workers what there is to do.  The task of `self`, if there is one for it, is
    // returned; the others are started.
    std::optional<Task> dispatch(const TileWorker* self = nullptr) {
        std::optional<Task> own;
        end_frames();
        while (!idle_.empty()) {
            const std::optional<Task> task = next_task();
            if (!task) break;
            TileWorker* const worker = take_worker();
            if (worker == self)
                own = task;
            else
                group_.run([this, task = *task, worker] { work(task, worker); });
        }
        end_frames();
        return own;
    }

    // Of the oldest frame first: it ends sooner, and gives its memory back.
    std::optional<Task> next_task() {
        for (const auto& frame : frames_) {
            if (cancel_) frame->cancel();
            if (const std::optional<Job> job = frame->next()) return Task{frame.get(), *job};
        }
        if (!wants_frame()) return std::nullopt;
        opening_ = true;
        return Task{nullptr, {}};
    }

    bool wants_frame() const {
        if (exhausted_ || opening_ || cancel_ || frames_.size() >= kFramesAtOnce) return false;
        if (frames_.empty()) return true;
        // The next frame is planned with what this one leaves it, and will want about what this one does.
        return frames_.back()->has_handed_on() &&
               (memory_ == 0 || 2 * frames_.back()->plan().memory_bytes <= memory_);
    }

    // One task after the other, as long as there is one for this worker.
    void work(Task first, TileWorker* worker) {
        for (std::optional<Task> task = first; task;) {
            const bool is_job = task->frame != nullptr;
            const std::exception_ptr error = is_job ? run_job(*task, *worker) : nullptr;
            std::unique_ptr<FrameRun> begun = is_job ? nullptr : supply_.next();
            const std::lock_guard lock(mutex_);
            try {
                if (is_job)
                    job_ended(*task, error);
                else
                    frame_begun(std::move(begun));
                idle_.push_back(worker);
                task = dispatch(worker);
            } catch (...) {  // no memory for the books: nobody goes on
                give_up();
                throw;
            }
        }
    }

    // A fault ends the frame and not the pool: jobs of it that are under way must end before it may go.
    static std::exception_ptr run_job(const Task& task, TileWorker& worker) {
        try {
            task.frame->run(task.job, worker);
            return nullptr;
        } catch (...) {
            return std::current_exception();
        }
    }

    void job_ended(const Task& task, const std::exception_ptr& error) {
        if (error) return task.frame->failed(task.job, error);
        task.frame->completed(task.job);
        supply_.went_on(*task.frame);
    }

    void frame_begun(std::unique_ptr<FrameRun> frame) {
        opening_ = false;
        if (frame)
            frames_.push_back(std::move(frame));
        else
            exhausted_ = true;
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

    // The one that was idle last: its scratch is still in the caches.
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
