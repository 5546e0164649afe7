// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/run/frame_run.h"

#include <atomic>
#include <cstddef>
#include <memory>
#include <vector>

namespace keyline {

// Where an executor gets its frames and what becomes of them.  Called by one thread at a time, any thread.
class FrameSupply {
public:
    virtual ~FrameSupply() = default;

    // The next frame, planned, with its outputs begun; null where there is none left.  Must not throw.
    virtual std::unique_ptr<FrameRun> next() = 0;

    // A frame is done, or ended by its error().  Frames end in the order they came in.  Returns whether to go
    // on; if not, the frames under way are given up.
    virtual bool ended(const FrameRun& frame) = 0;

    // Some more of a frame is done.  Other than the calls above it comes at any time; it must be quick.
    virtual void went_on(const FrameRun& /*frame*/) {}
};

// Runs frames on a number of threads.  While the last jobs of one frame run, the next is read: workers that
// the older frame has no job for serve the younger.
class Executor {
public:
    // `memory` is the most that frames at work at once may be estimated to use; 0: no limit.
    explicit Executor(int threads, std::size_t memory = 0);

    // Runs all frames of the supply.  Throws Failure (kCancelled) once `cancel` is true, which is looked at
    // between jobs; frames under way then leave nothing.
    void run(FrameSupply& supply, const std::atomic<bool>& cancel);

    // One frame.  Throws what ended it.
    void run(std::unique_ptr<FrameRun> frame, const std::atomic<bool>& cancel);

private:
    int threads_;
    std::size_t memory_;
    std::vector<std::unique_ptr<TileWorker>> workers_;
};

}  // namespace keyline
