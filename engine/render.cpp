// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/render.h"

#include "engine/execute.h"
#include "engine/output_check.h"

#include <algorithm>

namespace keyline {

namespace {

ResolveOptions resolve_options(const Graph& graph, const RenderOptions& options, bool every_node) {
    return {options.ocio.empty() ? graph.ocio() : options.ocio, every_node};
}

std::optional<ResolvedFrame> resolve_checked(const Graph& graph, int frame, const RenderOptions& options,
                                             bool every_node, Diagnostics& diagnostics) {
    auto resolved = resolve(graph, frame, resolve_options(graph, options, every_node), diagnostics);
    if (!resolved) return std::nullopt;
    check_outputs(*resolved, diagnostics);
    if (!diagnostics.ok()) return std::nullopt;
    return resolved;
}

// One render: the frames one after the other.
class Render {
public:
    Render(const Graph& graph, const RenderOptions& options, RenderObserver& observer,
           const std::atomic<bool>& cancel)
        : graph_(graph),
          options_(options),
          observer_(observer),
          cancel_(cancel),
          executor_(options.threads) {}

    RenderResult run() {
        if (!first_frame_is_sound()) return result_;
        for (const int frame : options_.frames) {
            const FrameOutcome outcome = run_frame(frame);
            observer_.frame_ended(frame, outcome);
            if (outcome == FrameOutcome::kDone) ++result_.done;
            if (outcome == FrameOutcome::kSkipped) ++result_.skipped;
            if (outcome == FrameOutcome::kFailed) ++result_.failed;
            if (outcome == FrameOutcome::kFailed && !options_.keep_going) break;
        }
        return result_;
    }

private:
    // A graph that is wrong fails as a whole; an input of the first frame that is missing fails that frame.
    bool first_frame_is_sound() {
        Diagnostics diagnostics;
        check(graph_, options_.frames.front(), options_, diagnostics);
        if (diagnostics.ok())
            check_outputs(graph_, options_.frames, resolve_options(graph_, options_, false), diagnostics);
        for (const Error& w : diagnostics.warnings()) observer_.warning(w);
        const bool wrong = std::ranges::any_of(diagnostics.errors(),
                                               [](const Error& e) { return e.kind == ErrorKind::kGraph; });
        if (!wrong) return true;
        for (const Error& e : diagnostics.errors()) observer_.error(e);
        result_.status = exit_status(ErrorKind::kGraph);
        result_.failed = 1;
        return false;
    }

    FrameOutcome run_frame(int frame) {
        if (cancel_) fail(ErrorKind::kCancelled, "cancelled");
        Diagnostics diagnostics;
        auto resolved = resolve_checked(graph_, frame, options_, false, diagnostics);
        if (frame != options_.frames.front())
            for (const Error& w : diagnostics.warnings()) observer_.warning(w);
        if (!resolved) return failed(diagnostics.errors());
        if (options_.skip_existing && skip_finished(*resolved)) return FrameOutcome::kSkipped;
        for (const Sink& sink : resolved->sinks) remove_leftovers(sink.request.file);
        try {
            FrameRun run(make_plan(std::move(*resolved), {options_.threads, options_.tile, options_.memory}));
            observer_.frame_started(frame, run.plan());
            executor_.run(run, cancel_);
            for (const Error& w : run.warnings()) observer_.warning(w);
        } catch (const Failure& f) {
            if (f.error().kind == ErrorKind::kCancelled) throw;
            return failed({f.error()});
        }
        return FrameOutcome::kDone;
    }

    FrameOutcome failed(const std::vector<Error>& errors) {
        for (const Error& e : errors) observer_.error(e);
        const bool graph =
            std::ranges::any_of(errors, [](const Error& e) { return e.kind == ErrorKind::kGraph; });
        if (result_.status == 0)
            result_.status = exit_status(graph ? ErrorKind::kGraph : errors.front().kind);
        return FrameOutcome::kFailed;
    }

    // Drops the outputs that are finished; true where none is left.
    static bool skip_finished(ResolvedFrame& frame) {
        std::erase_if(frame.sinks, [](const Sink& s) { return is_finished(s.request.file, s.request.spec); });
        return frame.sinks.empty();
    }

    const Graph& graph_;
    const RenderOptions& options_;
    RenderObserver& observer_;
    const std::atomic<bool>& cancel_;
    Executor executor_;
    RenderResult result_;
};

}  // namespace

void check(const Graph& graph, int frame, const RenderOptions& options, Diagnostics& diagnostics) {
    resolve_checked(graph, frame, options, true, diagnostics);
    diagnostics.sort_by_place();
}

std::optional<Plan> plan_frame(const Graph& graph, int frame, const RenderOptions& options,
                               Diagnostics& diagnostics) {
    auto resolved = resolve_checked(graph, frame, options, false, diagnostics);
    if (!resolved) return std::nullopt;
    try {
        return make_plan(std::move(*resolved), {options.threads, options.tile, options.memory});
    } catch (const Failure& f) {
        diagnostics.error(f.error());
        return std::nullopt;
    }
}

RenderResult render(const Graph& graph, const RenderOptions& options, RenderObserver& observer,
                    const std::atomic<bool>& cancel) {
    return Render(graph, options, observer, cancel).run();
}

}  // namespace keyline
