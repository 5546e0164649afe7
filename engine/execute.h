// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/frame_run.h"

#include <atomic>
#include <functional>
#include <memory>

namespace keyline {

// Runs frames on a number of threads.
class Executor {
public:
    explicit Executor(int threads);

    // Runs the frame to its end.  Throws what ended it: the Failure of a job, or one of kind kCancelled once
    // `cancel` is true, which is looked at between jobs.
    void run(FrameRun& frame, const std::atomic<bool>& cancel);

private:
    class Pool;
    int threads_;
    std::vector<std::unique_ptr<TileWorker>> workers_;
};

}  // namespace keyline
