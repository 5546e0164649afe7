// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/graph/graph.h"
#include "engine/plan/plan.h"
#include "engine/run/stats.h"

#include <atomic>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace KEYLINE_API keyline {

struct RenderOptions {
    std::vector<int> frames;
    int threads = 1;
    int tile = 0;                                  // pixels; 0: the planner's choice
    std::size_t memory = 0;                        // bytes for the whole process; 0: no limit
    Place memory_place;                            // the option that said so; empty: memory_by did
    std::string memory_by;                         // for messages: "half of the machine's"
    std::filesystem::path ocio;                    // the config; empty: the graph's, else the built-in one
    bool skip_existing = false;                    // leave finished outputs alone
    bool only_stale = false;                       // leave outputs alone that are current (verify.h)
    bool provenance = true;                        // is written into outputs whose format holds it
    bool keep_going = false;                       // after a frame that failed
    std::chrono::milliseconds wait_inputs{0};      // how long a frame waits for inputs that are not whole yet
    Recorder* recorder = nullptr;                  // told where the time goes; null: nothing is recorded
    std::string command = "keyline render GRAPH";  // that an internal error tells how to be seen again
    // Keeps what was read from files for the runs that it is given to; null: for one run.
    std::shared_ptr<Session> session;
};

enum class FrameOutcome { kDone, kSkipped, kFailed };

// Hears of a render as it goes.  Called by one thread at a time, any thread.  Two frames may be at work at
// once; they end in order, but one that can't even be begun is told at once.
class RenderObserver {
public:
    virtual ~RenderObserver() = default;
    virtual void frame_started(int /*frame*/, const Plan& /*plan*/) {}
    virtual void frame_ended(int /*frame*/, FrameOutcome /*outcome*/) {}
    // A frame was done or skipped, and at the end of the run an output of it is not there.  An error follows.
    virtual void frame_lost(int /*frame*/, FrameOutcome /*was*/) {}
    // How much of a frame at work is done, 0 to 1.  Other than the rest it may come while another call is
    // under way, and it comes often.
    virtual void frame_went_on(int /*frame*/, double /*part*/) {}
    // A frame can't be begun yet: an input of it is not there, or not whole.  Told again where
    // that is another thing than before.
    virtual void frame_waits(int /*frame*/, const Error& /*for_what*/) {}
    virtual void warning(const Error& /*warning*/) {}
    virtual void error(const Error& /*error*/) {}
};

struct RenderResult {
    int done = 0, skipped = 0, failed = 0;
    std::optional<Error>
        cause;                 // why not all is well: of the first frame whose failure stays, else the first
    std::vector<int> untried;  // frames that a failed one kept from being rendered

    int status() const { return cause ? exit_status(*cause) : 0; }  // as the program exits
};

// Checks the graph for a frame without computing a pixel: every node's parameters, files' headers, layers and
// links, the outputs against each other and the inputs, whether inputs are whole and outputs can be written.
// Returns what every node makes; nothing where there was an error.
std::optional<ResolvedFrame> check(const Graph& graph, int frame, const RenderOptions& options,
                                   Diagnostics& diagnostics);

// What a render finds out about its frames before it computes a pixel of them: check() for each, with what
// several have in common told once, and the frames against each other.  `hear` is given
// what check() returns.
void check_frames(const Graph& graph, const std::vector<int>& frames, const RenderOptions& options,
                  Diagnostics& diagnostics, const std::function<void(const ResolvedFrame&)>& hear = {});

// What else is wrong with a graph that is known to be faulty (Graph::load_what_is_sound): with its sound
// nodes, their files and links.
void check_what_is_sound(const Graph& graph, int frame, const RenderOptions& options,
                         Diagnostics& diagnostics);

// The plan for a frame.  Nothing where there was an error; it is in the diagnostics.
std::optional<Plan> plan_frame(const Graph& graph, int frame, const RenderOptions& options,
                               Diagnostics& diagnostics);

// The plans of a run's frames, each with what those before it leave.  Ends at the first error.
void plan_frames(const Graph& graph, const std::vector<int>& frames, const RenderOptions& options,
                 Diagnostics& diagnostics, const std::function<void(const Plan&)>& hear);

// Renders the frames in order.  The first is checked whole before any pixel, each later one before its own.
// At the end every output is looked at once more: a run ends well only where all are there. Errors go to the
// observer.  Throws Failure (kCancelled) once `cancel` is true; no output of an unfinished frame is left.
RenderResult render(const Graph& graph, const RenderOptions& options, RenderObserver& observer,
                    const std::atomic<bool>& cancel);

}  // namespace keyline
