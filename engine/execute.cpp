// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/execute.h"

#include <mutex>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

namespace keyline {

// One frame under way: each job that ends hands out those that became ready.
class Executor::Pool {
public:
    Pool(FrameRun& frame, std::vector<std::unique_ptr<TileWorker>>& workers, const std::atomic<bool>& cancel)
        : frame_(frame), cancel_(cancel) {
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
    // Under the lock: starts ready jobs while a worker is idle.
    void dispatch() {
        if (cancel_) frame_.cancel();
        while (!idle_.empty()) {
            const std::optional<Job> job = frame_.next();
            if (!job) return;
            TileWorker* worker = idle_.back();
            idle_.pop_back();
            group_.run([this, job = *job, worker] { work(job, worker); });
        }
    }

    void work(const Job& job, TileWorker* worker) {
        std::exception_ptr error;
        try {
            frame_.run(job, *worker);
        } catch (...) {
            error = std::current_exception();
        }
        const std::lock_guard lock(mutex_);
        if (error)
            frame_.failed(job, error);
        else
            frame_.completed(job);
        idle_.push_back(worker);
        dispatch();
    }

    FrameRun& frame_;
    const std::atomic<bool>& cancel_;
    std::mutex mutex_;
    std::vector<TileWorker*> idle_;
    tbb::task_group group_;
};

Executor::Executor(int threads) : threads_(threads) {
    for (int i = 0; i < threads; ++i) workers_.push_back(std::make_unique<TileWorker>());
}

void Executor::run(FrameRun& frame, const std::atomic<bool>& cancel) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads_));
    tbb::task_arena arena(threads_);
    arena.execute([&] { Pool(frame, workers_, cancel).run(); });
    if (frame.error()) std::rethrow_exception(frame.error());
    if (cancel) fail(ErrorKind::kCancelled, "cancelled");
    if (!frame.done()) fail(ErrorKind::kInternal, "the frame ended with work left to do");
}

}  // namespace keyline
