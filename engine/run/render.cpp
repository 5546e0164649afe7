// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/run/render.h"

#include "engine/base/index.h"
#include "engine/plan/output_check.h"
#include "engine/plan/planner.h"
#include "engine/plan/size_check.h"
#include "engine/run/ahead.h"
#include "engine/run/execute.h"
#include "engine/run/last_look.h"
#include "engine/run/one_tile.h"
#include "engine/run/verify.h"
#include "engine/run/wait_inputs.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <map>
#include <memory>
#include <new>
#include <set>
#include <thread>
#include <unordered_set>

namespace keyline {

namespace {

std::filesystem::path ocio_of(const Graph& graph, const RenderOptions& options) {
    return options.ocio.empty() ? graph.ocio() : options.ocio;
}

ResolveOptions resolve_options(const Graph& graph, const RenderOptions& options, bool every_node) {
    ResolveOptions out;
    out.ocio = ocio_of(graph, options);
    out.every_node = every_node;
    out.session = options.session;
    return out;
}

std::optional<ResolvedFrame> resolve_checked(const Graph& graph, int frame, const ResolveOptions& options,
                                             Diagnostics& diagnostics) {
    auto resolved = resolve(graph, frame, options, diagnostics);
    if (!resolved) return std::nullopt;
    check_outputs(*resolved, diagnostics);
    if (diagnostics.ok()) check_inputs(graph, *resolved, diagnostics);
    if (!diagnostics.ok()) return std::nullopt;
    return resolved;
}

// Too little memory is the fault of who said how much there is: the command line, or the machine and what a
// render farm allots of it.
Plan planned(ResolvedFrame frame, const RenderOptions& options, bool weigh_all, std::span<const Carried> held,
             std::span<const ComingFrame> coming, std::size_t at_work = 0) {
    try {
        return make_plan(std::move(frame),
                         {options.threads, options.tile, options.memory, weigh_all, held, coming, at_work});
    } catch (const Failure& f) {
        if (f.error().kind != ErrorKind::kGraph) throw;
        rethrow_with(f, [&](Error& e) {
            e.place = options.memory_place;
            if (!e.place.file.empty() || options.memory_by.empty()) return;
            e.kind = ErrorKind::kFailed;
            e.passing = Passing::kMemory;
            e.hint = fmt::format("it is {}; have the task allotted more, or {}", options.memory_by, e.hint);
        });
    }
}

bool any_of_graph(const std::vector<Error>& errors) {
    return std::ranges::any_of(errors, [](const Error& e) { return e.kind == ErrorKind::kGraph; });
}

// Whether another try would fail too.
bool stays(const std::optional<Error>& error) { return error && error->passing == Passing::kNever; }

// Of a frame that comes after others, whose faults of the graph are known.
ResolveOptions resolve_later(const Graph& graph, const RenderOptions& options) {
    ResolveOptions out = resolve_options(graph, options, false);
    out.known_sound = true;
    return out;
}

// One render: hands the executor frame after frame and keeps count of what became of them.
class Render final : public FrameSupply {
public:
    Render(const Graph& graph, RenderOptions options, RenderObserver& observer)
        : graph_(graph),
          options_(with_session(std::move(options))),
          observer_(observer),
          ahead_(graph, options_.frames, resolve_later(graph, options_),
                 [this](ResolvedFrame& frame) { skip_finished(frame); }),
          origins_(graph, ocio_of(graph, options_), options_.session),
          last_look_(graph, options_.frames) {}

    RenderResult run(const std::atomic<bool>& cancel) {
        if (!first_frame_is_sound()) return result_;
        cancel_ = &cancel;
        Executor(options_.threads, options_.memory).run(*this, cancel);
        look_once_more();
        // A frame that failed took those with it that were being read beside it, and those after it.
        for (const int frame : options_.frames)
            if (open_.contains(frame)) result_.untried.push_back(frame);
        return result_;
    }

    std::unique_ptr<FrameRun> next() override {
        while (next_ < options_.frames.size()) {
            const int frame = options_.frames[next_++];
            open_.insert(frame);
            if (auto run = begin(frame)) return run;
        }
        return nullptr;
    }

    void went_on(const FrameRun& run) override {
        observer_.frame_went_on(run.plan().frame.frame, run.part());
    }

    bool ended(const FrameRun& run) override {
        for (const Error& w : run.warnings()) observer_.warning(w);
        const int frame = run.plan().frame.frame;
        if (!run.error()) return frame_written(run.plan().frame);
        return frame_failed(frame, {error_of(frame, run.error())});
    }

private:
    static RenderOptions with_session(RenderOptions options) {
        if (!options.session) options.session = std::make_shared<Session>();
        return options;
    }

    // A graph that is wrong fails as a whole; an input of the first frame that is missing fails that frame.
    bool first_frame_is_sound() {
        Diagnostics diagnostics;
        check(graph_, options_.frames.front(), options_, diagnostics);
        if (!any_of_graph(diagnostics.errors()))
            check_outputs(graph_, options_.frames, resolve_options(graph_, options_, false), diagnostics);
        for (const Error& w : diagnostics.warnings()) observer_.warning(w);
        if (!any_of_graph(diagnostics.errors())) return true;
        for (const Error& e : diagnostics.errors()) observer_.error(e);
        result_.cause = decisive(diagnostics.errors());
        result_.failed = 1;
        return false;
    }

    // An output had its name when its frame ended; another process or a server may have taken it since.
    void look_once_more() {
        const LastLook::Lost lost = last_look_.lost();
        for (const auto& [frame, was] : lost.frames) {
            observer_.frame_lost(frame, was);
            --(was == FrameOutcome::kDone ? result_.done : result_.skipped);
            ++result_.failed;
        }
        for (const Error& e : lost.errors) observer_.error(e);
        if (!lost.errors.empty() && !stays(result_.cause)) result_.cause = lost.errors.front();
    }

    // A frame is checked anew, for its files are others; what the first has told of the graph is not told
    // again. A frame's plan with its outputs begun; null where it is skipped or failed, which is told.
    std::unique_ptr<FrameRun> begin(int frame) {
        Diagnostics diagnostics;
        try {
            ResolveOptions resolving = resolve_options(graph_, options_, false);
            resolving.known_sound = frame != options_.frames.front();
            resolving.inputs_may_come = options_.wait_inputs.count() > 0;
            auto resolved = resolve_when_ready(frame, resolving, diagnostics);
            if (resolving.known_sound)
                for (const Error& w : diagnostics.warnings()) observer_.warning(w);
            if (!resolved && *cancel_) return nullptr;
            if (!resolved) return frame_failed(frame, diagnostics.errors()), nullptr;
            tidy(*resolved);
            if (skips_some() && skip_finished(*resolved))
                return count(frame, FrameOutcome::kSkipped), nullptr;
            const std::span<const ComingFrame> coming = ahead_.after(*resolved, next_);
            Plan plan = planned(std::move(*resolved), options_, false, *held_, coming, bytes_at_work());
            if (options_.provenance) sign(plan.frame);  // `keyline plan` must say the same, and signs nothing
            *held_ = plan.carrying.held;  // what nobody wants any more goes before the frame begins
            auto run = std::make_unique<FrameRun>(std::move(plan), options_.recorder, held_);
            at_work_[frame] = run->plan().memory_bytes;
            observer_.frame_started(frame, run->plan());
            return run;
        } catch (...) {
            frame_failed(frame, {error_of(frame, std::current_exception())});
        }
        return nullptr;
    }

    // Where it is asked to wait, a frame is looked at until its inputs are whole.
    std::optional<ResolvedFrame> resolve_when_ready(int frame, const ResolveOptions& resolving,
                                                    Diagnostics& diagnostics) {
        // Looks become rare: to open some formats takes a library's start.
        constexpr std::chrono::milliseconds kLongestPause(2000);
        std::chrono::milliseconds pause(200);
        const auto end = std::chrono::steady_clock::now() + options_.wait_inputs;
        std::string told;
        while (true) {
            Diagnostics found;
            auto resolved = resolve_checked(graph_, frame, resolving, found);
            if (resolved && options_.wait_inputs.count() > 0) check_at_rest(*resolved, found);
            const bool waits = options_.wait_inputs.count() > 0 && may_come(found.errors());
            const bool is_over = *cancel_ || std::chrono::steady_clock::now() >= end;
            if (!waits || is_over) {
                for (const Error& w : found.warnings()) diagnostics.warning(w);
                for (const Error& e : found.errors()) diagnostics.error(e);
                return found.ok() ? std::move(resolved) : std::nullopt;
            }
            if (const Error& what = found.errors().front(); what.what != told) {
                observer_.frame_waits(frame, what);
                told = what.what;
            }
            std::this_thread::sleep_for(pause);
            pause = std::min(2 * pause, kLongestPause);
        }
    }

    // Frames overlap: what is carried to coming ones must fit beside all that are at work.
    std::size_t bytes_at_work() const {
        std::size_t sum = 0;
        for (const auto& [frame, bytes] : at_work_) sum += bytes;
        return sum;
    }

    // Each folder once: to list one with ten thousand frames, on a server, takes longer than many a frame.
    void tidy(const ResolvedFrame& frame) {
        for (const Sink& sink : frame.sinks)
            if (tidied_.insert(sink.request.file.parent_path()).second) remove_leftovers(sink.request.file);
    }

    Error error_of(int frame, const std::exception_ptr& thrown) const {
        const std::string who = fmt::format("frame {}", frame);
        try {
            std::rethrow_exception(thrown);
        } catch (const TileFailure& f) {
            Error e = f.error();
            const std::string& id = graph_.nodes()[index(f.node)].id;
            e.hint = fmt::format("'{}' runs this alone; please report it with that",
                                 command_for(options_.command, {id, f.frame, f.region}));
            return e;
        } catch (const Failure& f) {
            return f.error();
        } catch (const std::bad_alloc&) {
            return {ErrorKind::kFailed, {}, who, "out of memory", "a smaller --memory makes it need less",
                    Passing::kMemory};
        } catch (const std::exception& e) {
            return {ErrorKind::kInternal, {}, who, e.what(), {}};
        }
    }

    // All four return whether to go on.
    bool frame_written(const ResolvedFrame& frame) {
        try {
            for (const Sink& s : frame.sinks)
                if (const Attribute* origin = s.request.spec.metadata.find(kProvenance);
                    options_.provenance && origin)
                    write_provenance_beside(s.request.file, std::get<std::string>(origin->value));
        } catch (...) {
            return frame_failed(frame.frame, {error_of(frame.frame, std::current_exception())});
        }
        return count(frame.frame, FrameOutcome::kDone);
    }

    bool frame_failed(int frame, const std::vector<Error>& errors) {
        for (const Error& e : errors) observer_.error(e);
        // Frames overlap: a later one may be the first to fail.
        const auto position = std::ranges::find(options_.frames, frame) - options_.frames.begin();
        const Error& error = decisive(errors);
        const bool outranks = stays(error) != stays(result_.cause);
        if (!result_.cause || (outranks ? stays(error) : position < first_failed_)) {
            result_.cause = error;
            first_failed_ = position;
        }
        return count(frame, FrameOutcome::kFailed);
    }

    bool count(int frame, FrameOutcome outcome) {
        open_.erase(frame);
        at_work_.erase(frame);
        if (outcome != FrameOutcome::kFailed) last_look_.remember(frame, outcome);
        observer_.frame_ended(frame, outcome);
        switch (outcome) {
            case FrameOutcome::kDone: ++result_.done; break;
            case FrameOutcome::kSkipped: ++result_.skipped; break;
            case FrameOutcome::kFailed: ++result_.failed; break;
        }
        const bool go_on = outcome != FrameOutcome::kFailed || options_.keep_going;
        if (!go_on && next_ < options_.frames.size()) {
            const auto rest = options_.frames.begin() + static_cast<std::ptrdiff_t>(next_);
            open_.insert(rest, options_.frames.end());
            next_ = options_.frames.size();
        }
        return go_on;
    }

    bool skips_some() const { return options_.skip_existing || options_.only_stale; }

    // Drops the outputs that are to be left alone; true where none is left.
    bool skip_finished(ResolvedFrame& frame) {
        std::erase_if(frame.sinks, [&](const Sink& s) {
            return (options_.skip_existing && is_there(s)) ||
                   (options_.only_stale && is_current(origins_, frame, s));
        });
        return frame.sinks.empty();
    }

    // A file of data appears whole: it is there, or it is not.
    static bool is_there(const Sink& s) {
        const bool finished = s.request.stream.is_data() ? std::filesystem::exists(s.request.file)
                                                         : is_finished(s.request.file, s.request.spec);
        return finished && !was_changed_since_made(s.request.file);
    }

    void sign(ResolvedFrame& frame) const {
        for (Sink& s : frame.sinks)
            s.request.spec.metadata.set({kProvenance, "string", origins_.of(frame, s).text});
    }

    const Graph& graph_;
    RenderOptions options_;
    RenderObserver& observer_;
    const std::atomic<bool>* cancel_ = nullptr;  // while it runs
    // What earlier frames left.  A frame adds to it before the next one is begun.
    const std::shared_ptr<std::vector<Carried>> held_ = std::make_shared<std::vector<Carried>>();
    Ahead ahead_;
    const Origins origins_;
    std::size_t next_ = 0;
    std::ptrdiff_t first_failed_ = 0;  // of options_.frames: whose failure is the cause
    RenderResult result_;
    std::map<int, std::size_t> at_work_;      // by frame: the bytes that its plan says
    std::set<std::filesystem::path> tidied_;  // folders
    LastLook last_look_;
    std::unordered_set<int> open_;  // frames begun and not ended; once one failed, those not begun too
};

}  // namespace

std::optional<ResolvedFrame> check(const Graph& graph, int frame, const RenderOptions& options,
                                   Diagnostics& diagnostics) {
    ResolveOptions resolving = resolve_options(graph, options, true);
    resolving.check_formats = true;
    auto resolved = resolve(graph, frame, resolving, diagnostics);
    if (resolved) {
        check_outputs(*resolved, diagnostics);
        check_inputs(graph, *resolved, diagnostics);
        check_places(*resolved, diagnostics);
        check_sizes(*resolved, diagnostics);
    }
    diagnostics.sort_by_place();
    if (!diagnostics.ok()) return std::nullopt;
    return resolved;
}

void check_frames(const Graph& graph, const std::vector<int>& frames, const RenderOptions& options,
                  Diagnostics& diagnostics, const std::function<void(const ResolvedFrame&)>& hear) {
    std::set<std::string> told;  // a fault of a thousand frames is one line
    for (const int frame : frames) {
        Diagnostics of_frame;
        const auto resolved = check(graph, frame, options, of_frame);
        if (resolved && hear) hear(*resolved);
        for (const Error& w : of_frame.warnings())
            if (told.insert(w.warning_text()).second) diagnostics.warning(w);
        for (const Error& e : of_frame.errors())
            if (told.insert(e.text()).second) diagnostics.error(e);
    }
    if (!any_of_graph(diagnostics.errors()))
        check_outputs(graph, frames, resolve_options(graph, options, false), diagnostics);
    diagnostics.sort_by_place();
}

void check_what_is_sound(const Graph& graph, int frame, const RenderOptions& options,
                         Diagnostics& diagnostics) {
    ResolveOptions resolving = resolve_options(graph, options, true);
    resolving.check_formats = resolving.faults_told = true;
    resolve(graph, frame, resolving, diagnostics);
    diagnostics.sort_by_place();
}

void plan_frames(const Graph& graph, const std::vector<int>& frames, const RenderOptions& options,
                 Diagnostics& diagnostics, const std::function<void(const Plan&)>& hear) {
    Ahead ahead(graph, frames, resolve_later(graph, options));
    // Nothing is run: what a frame would leave is handed on without its samples.
    std::vector<Carried> held;
    for (std::size_t i = 0; i < frames.size() && diagnostics.ok(); ++i) {
        ResolveOptions resolving = resolve_options(graph, options, false);
        resolving.check_formats = true;
        auto resolved = resolve_checked(graph, frames[i], resolving, diagnostics);
        if (resolved) check_sizes(*resolved, diagnostics);
        if (!diagnostics.ok()) return;
        try {
            const std::span<const ComingFrame> coming = ahead.after(*resolved, i + 1);
            const Plan plan = planned(std::move(*resolved), options, true, held, coming);
            held = plan.carrying.held;
            std::ranges::move(to_hand_on(plan), std::back_inserter(held));
            hear(plan);
        } catch (const Failure& f) {
            diagnostics.error(f.error());
        }
    }
}

std::optional<Plan> plan_frame(const Graph& graph, int frame, const RenderOptions& options,
                               Diagnostics& diagnostics) {
    std::optional<Plan> out;
    plan_frames(graph, {frame}, options, diagnostics, [&](const Plan& plan) { out = plan; });
    return out;
}

RenderResult render(const Graph& graph, const RenderOptions& options, RenderObserver& observer,
                    const std::atomic<bool>& cancel) {
    return Render(graph, options, observer).run(cancel);
}

}  // namespace keyline
