// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/graph.h"
#include "engine/plan.h"
#include "engine/stats.h"

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <vector>

namespace keyline {

struct RenderOptions {
    std::vector<int> frames;
    int threads = 1;
    int tile = 0;                  // pixels; 0: the planner's choice
    std::size_t memory = 0;        // bytes for the whole process; 0: no limit
    std::filesystem::path ocio;    // the config; empty: the graph's, else the built-in one
    bool skip_existing = false;    // leave finished outputs alone
    bool keep_going = false;       // after a frame that failed
    Recorder* recorder = nullptr;  // told where the time goes; null: nothing is recorded
};

enum class FrameOutcome { kDone, kSkipped, kFailed };

// Hears of a render as it goes.  Called by one thread at a time, any thread.  Two frames may be at work at
// once; they end in order, but one that can't even be begun is told at once.
class RenderObserver {
public:
    virtual ~RenderObserver() = default;
    virtual void frame_started(int /*frame*/, const Plan& /*plan*/) {}
    virtual void frame_ended(int /*frame*/, FrameOutcome /*outcome*/) {}
    virtual void warning(const Error& /*warning*/) {}
    virtual void error(const Error& /*error*/) {}
};

struct RenderResult {
    int done = 0, skipped = 0, failed = 0;
    int status = 0;  // as the program exits: that of the first frame that failed
};

// Checks the graph for a frame without computing a pixel: every node's parameters, files' headers, layers and
// links, and the outputs against each other and the inputs.
void check(const Graph& graph, int frame, const RenderOptions& options, Diagnostics& diagnostics);

// What else is wrong with a graph that is known to be faulty (Graph::load_what_is_sound): with its sound
// nodes, their files and links.
void check_what_is_sound(const Graph& graph, int frame, const RenderOptions& options,
                         Diagnostics& diagnostics);

// The plan for a frame.  Nothing where there was an error; it is in the diagnostics.
std::optional<Plan> plan_frame(const Graph& graph, int frame, const RenderOptions& options,
                               Diagnostics& diagnostics);

// Renders the frames in order.  The first is checked whole before any pixel, each later one before its own.
// Errors go to the observer.  Throws Failure (kCancelled) once `cancel` is true; no output of an unfinished
// frame is left.
RenderResult render(const Graph& graph, const RenderOptions& options, RenderObserver& observer,
                    const std::atomic<bool>& cancel);

}  // namespace keyline
