// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/render.h"

#include "engine/execute.h"
#include "engine/output_check.h"

#include <algorithm>
#include <fmt/format.h>
#include <memory>
#include <new>

namespace keyline {

namespace {

ResolveOptions resolve_options(const Graph& graph, const RenderOptions& options, bool every_node) {
    ResolveOptions out;
    out.ocio = options.ocio.empty() ? graph.ocio() : options.ocio;
    out.every_node = every_node;
    return out;
}

std::optional<ResolvedFrame> resolve_checked(const Graph& graph, int frame, const ResolveOptions& options,
                                             Diagnostics& diagnostics) {
    auto resolved = resolve(graph, frame, options, diagnostics);
    if (!resolved) return std::nullopt;
    check_outputs(*resolved, diagnostics);
    if (!diagnostics.ok()) return std::nullopt;
    return resolved;
}

bool any_of_graph(const std::vector<Error>& errors) {
    return std::ranges::any_of(errors, [](const Error& e) { return e.kind == ErrorKind::kGraph; });
}

// One render: hands the executor frame after frame and keeps count of what became of them.
class Render final : public FrameSupply {
public:
    Render(const Graph& graph, const RenderOptions& options, RenderObserver& observer)
        : graph_(graph), options_(options), observer_(observer) {}

    RenderResult run(const std::atomic<bool>& cancel) {
        if (first_frame_is_sound()) Executor(options_.threads, options_.memory).run(*this, cancel);
        return result_;
    }

    std::unique_ptr<FrameRun> next() override {
        while (next_ < options_.frames.size()) {
            const int frame = options_.frames[next_++];
            if (auto run = begin(frame)) return run;
        }
        return nullptr;
    }

    bool ended(const FrameRun& run) override {
        for (const Error& w : run.warnings()) observer_.warning(w);
        const int frame = run.plan().frame.frame;
        if (!run.error()) return count(frame, FrameOutcome::kDone);
        return frame_failed(frame, {error_of(frame, run.error())});
    }

private:
    // A graph that is wrong fails as a whole; an input of the first frame that is missing fails that frame.
    bool first_frame_is_sound() {
        Diagnostics diagnostics;
        check(graph_, options_.frames.front(), options_, diagnostics);
        if (!any_of_graph(diagnostics.errors()))
            check_outputs(graph_, options_.frames, resolve_options(graph_, options_, false), diagnostics);
        for (const Error& w : diagnostics.warnings()) observer_.warning(w);
        if (!any_of_graph(diagnostics.errors())) return true;
        for (const Error& e : diagnostics.errors()) observer_.error(e);
        result_.status = exit_status(ErrorKind::kGraph);
        result_.failed = 1;
        return false;
    }

    // A frame's plan with its outputs begun; null where it is skipped or failed, which is told.
    std::unique_ptr<FrameRun> begin(int frame) {
        Diagnostics diagnostics;
        try {
            ResolveOptions resolving = resolve_options(graph_, options_, false);
            resolving.known_sound = frame != options_.frames.front();
            auto resolved = resolve_checked(graph_, frame, resolving, diagnostics);
            if (resolving.known_sound)
                for (const Error& w : diagnostics.warnings()) observer_.warning(w);
            if (!resolved) return frame_failed(frame, diagnostics.errors()), nullptr;
            if (options_.skip_existing && skip_finished(*resolved))
                return count(frame, FrameOutcome::kSkipped), nullptr;
            for (const Sink& sink : resolved->sinks) remove_leftovers(sink.request.file);
            auto run = std::make_unique<FrameRun>(
                make_plan(std::move(*resolved), {options_.threads, options_.tile, options_.memory}),
                options_.recorder);
            observer_.frame_started(frame, run->plan());
            return run;
        } catch (...) {
            frame_failed(frame, {error_of(frame, std::current_exception())});
        }
        return nullptr;
    }

    static Error error_of(int frame, const std::exception_ptr& thrown) {
        const std::string who = fmt::format("frame {}", frame);
        try {
            std::rethrow_exception(thrown);
        } catch (const Failure& f) {
            return f.error();
        } catch (const std::bad_alloc&) {
            return {ErrorKind::kFailed, {}, who, "out of memory", "a smaller --memory makes it need less"};
        } catch (const std::exception& e) {
            return {ErrorKind::kInternal, {}, who, e.what(), {}};
        }
    }

    // All three return whether to go on.
    bool frame_failed(int frame, const std::vector<Error>& errors) {
        for (const Error& e : errors) observer_.error(e);
        // Frames overlap: a later one may be the first to fail.
        const auto position = std::ranges::find(options_.frames, frame) - options_.frames.begin();
        if (result_.status == 0 || position < first_failed_) {
            result_.status = exit_status(any_of_graph(errors) ? ErrorKind::kGraph : errors.front().kind);
            first_failed_ = position;
        }
        return count(frame, FrameOutcome::kFailed);
    }

    bool count(int frame, FrameOutcome outcome) {
        observer_.frame_ended(frame, outcome);
        switch (outcome) {
            case FrameOutcome::kDone: ++result_.done; break;
            case FrameOutcome::kSkipped: ++result_.skipped; break;
            case FrameOutcome::kFailed: ++result_.failed; break;
        }
        const bool go_on = outcome != FrameOutcome::kFailed || options_.keep_going;
        if (!go_on) next_ = options_.frames.size();
        return go_on;
    }

    // Drops the outputs that are finished; true where none is left.
    static bool skip_finished(ResolvedFrame& frame) {
        std::erase_if(frame.sinks, [](const Sink& s) { return is_finished(s.request.file, s.request.spec); });
        return frame.sinks.empty();
    }

    const Graph& graph_;
    const RenderOptions& options_;
    RenderObserver& observer_;
    std::size_t next_ = 0;
    std::ptrdiff_t first_failed_ = 0;  // of options_.frames, where status is not 0
    RenderResult result_;
};

}  // namespace

void check(const Graph& graph, int frame, const RenderOptions& options, Diagnostics& diagnostics) {
    ResolveOptions resolving = resolve_options(graph, options, true);
    resolving.check_formats = true;
    resolve_checked(graph, frame, resolving, diagnostics);
    diagnostics.sort_by_place();
}

void check_what_is_sound(const Graph& graph, int frame, const RenderOptions& options,
                         Diagnostics& diagnostics) {
    ResolveOptions resolving = resolve_options(graph, options, true);
    resolving.check_formats = resolving.faults_told = true;
    resolve(graph, frame, resolving, diagnostics);
    diagnostics.sort_by_place();
}

std::optional<Plan> plan_frame(const Graph& graph, int frame, const RenderOptions& options,
                               Diagnostics& diagnostics) {
    auto resolved = resolve_checked(graph, frame, resolve_options(graph, options, false), diagnostics);
    if (!resolved) return std::nullopt;
    try {
        return make_plan(std::move(*resolved), {options.threads, options.tile, options.memory, true});
    } catch (const Failure& f) {
        diagnostics.error(f.error());
        return std::nullopt;
    }
}

RenderResult render(const Graph& graph, const RenderOptions& options, RenderObserver& observer,
                    const std::atomic<bool>& cancel) {
    return Render(graph, options, observer).run(cancel);
}

}  // namespace keyline
