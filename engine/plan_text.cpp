// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/describe.h"
#include "engine/plan.h"
#include "engine/plan_memory.h"

#include <algorithm>
#include <fmt/format.h>

namespace keyline {

namespace {

std::string counted(std::size_t n, const char* what) {
    return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

// Writes down one plan.
class PlanText {
public:
    explicit PlanText(const Plan& plan) : plan_(plan) {}

    std::string text() {
        line(0, fmt::format("frame {}: {} on {}, {} of memory", plan_.frame.frame,
                            counted(plan_.sweeps.size(), "sweep"),
                            counted(static_cast<std::size_t>(plan_.threads), "thread"),
                            memory_text(plan_.memory_bytes)));
        for (const Op& op : plan_.frame.ops)
            if (op.source && plan_.demand.needs(index(op))) input(op);
        for (const Sink& sink : plan_.frame.sinks) output(sink);
        for (std::size_t i = 0; i < plan_.sweeps.size(); ++i) sweep(i);
        if (!plan_.weighed.empty()) choices();
        return std::move(text_);
    }

private:
    void line(int indent, const std::string& text) {
        text_ += std::string(static_cast<std::size_t>(2 * indent), ' ') + text + "\n";
    }
    void entry(const char* label, const std::string& text) { line(1, fmt::format("{:<9}{}", label, text)); }

    std::size_t index(const Op& op) const { return static_cast<std::size_t>(&op - plan_.frame.ops.data()); }
    const Op& op(int i) const { return plan_.frame.ops[static_cast<std::size_t>(i)]; }
    std::string file_of(int source_op) const {
        return op(source_op).source->header().file.lexically_normal().string();
    }

    static std::string file_of(const Sink& sink) { return sink.request.file.lexically_normal().string(); }

    ChannelInfo source_channel(ValueRef v) const {
        const Op& source = op(v.op);
        const auto output = static_cast<std::size_t>(v.output);
        return source.source->header()
            .groups[source.source_group[output]]
            .channels[source.source_channel[output]];
    }

    std::string channels_of(const std::vector<ValueRef>& values) const {
        std::vector<ValueRef> sorted = values;
        std::ranges::sort(sorted);
        std::vector<ChannelInfo> channels;
        for (const ValueRef v : sorted) channels.push_back(source_channel(v));
        return describe(channels);
    }

    void input(const Op& source) {
        const int i = static_cast<int>(index(source));
        std::vector<ValueRef> read;
        for (int o = 0; o < static_cast<int>(source.outputs.size()); ++o)
            if (!plan_.demand.of({i, o}).empty()) read.push_back({i, o});
        const ImageHeader& header = source.source->header();
        line(0, fmt::format("\ninput {}, {}", file_of(i), source.title));
        if (source.frame != plan_.frame.frame) entry("frame", std::to_string(source.frame));
        entry("display", describe(header.display_window));
        entry("data", describe(header.data_window));
        entry("reads", fmt::format("{} of {}: {}", read.size(), counted(source.outputs.size(), "channel"),
                                   channels_of(read)));
        entry("region", describe(plan_.demand.region(index(source))));
    }

    void output(const Sink& sink) {
        line(0, fmt::format("\noutput {}, {}", file_of(sink), sink.title));
        entry("display", describe(sink.request.spec.display_window));
        entry("data", describe(sink.request.spec.data_window));
        entry("writes", describe(sink.request.spec.channels));
    }

    void sweep(std::size_t i) {
        const Sweep& s = plan_.sweeps[i];
        line(0, fmt::format("\nsweep {} of {}: {}, {} of {} × {}, {} of memory", i + 1, plan_.sweeps.size(),
                            describe(s.area), counted(s.columns.size() * s.rows.size(), "tile"), s.tile_width,
                            s.tile_height, memory_text(s.memory_bytes)));
        for (const int store : s.reads) decode(plan_.stores[static_cast<std::size_t>(store)], i);
        steps(s);
        for (const Root& root : s.roots) leave(root);
    }

    void decode(const Store& store, std::size_t sweep) {
        std::string text = fmt::format("{}, {}: {}", file_of(store.source_op), describe(store.region),
                                       channels_of(store.values));
        if (store.last_sweep > static_cast<int>(sweep))
            text +=
                fmt::format("; kept, {}, until sweep {}", memory_text(store.bytes()), store.last_sweep + 1);
        entry("decode", text);
    }

    // What a step does to whom.  A node that works channel by channel is one line, not one a channel.
    std::pair<const char*, std::string> told(const Step& step) const {
        const Op& o = op(step.op);
        switch (step.kind) {
            case Step::Kind::kLoad:
                if (o.source) return {"", ""};  // decoding was told
                return {"load", o.title + ", kept from an earlier sweep"};
            case Step::Kind::kApply: return {"apply", o.title};
            case Step::Kind::kCompute: break;
        }
        const Halo halo = o.operation->halo();
        if (halo == Halo{}) return {"compute", o.title};
        return {"compute", fmt::format("{}, reach {} × {}", o.title, halo.x, halo.y)};
    }

    void steps(const Sweep& s) {
        for (std::size_t i = 0; i < s.steps.size();) {
            const auto [what, whom] = told(s.steps[i]);
            std::size_t end = i + 1;
            while (end < s.steps.size() && told(s.steps[end]) == std::pair(what, whom)) ++end;
            if (*what)
                entry(what, end - i == 1 ? whom : fmt::format("{}, {}", whom, counted(end - i, "channel")));
            i = end;
        }
    }

    void leave(const Root& root) {
        switch (root.kind) {
            case Root::Kind::kMap:
                return entry("gather", fmt::format("{}, from {}", op(root.op).title, describe(root.region)));
            case Root::Kind::kKeep: {
                const Store& store = plan_.stores[static_cast<std::size_t>(root.store)];
                return entry("keep", fmt::format("{}, {}, {}, until sweep {}",
                                                 op(store.values.front().op).title, describe(store.region),
                                                 memory_text(store.bytes()), store.last_sweep + 1));
            }
            case Root::Kind::kSink: break;
        }
        const Sink& sink = plan_.frame.sinks[static_cast<std::size_t>(root.sink)];
        const auto untouched = std::ranges::count(root.untouched, true);
        std::string text = fmt::format("{}, {}", file_of(sink), counted(root.operands.size(), "channel"));
        if (untouched > 0) text += fmt::format(", {} as they are in the input", untouched);
        entry("write", text);
    }

    // Work is told against the fastest's: the model's seconds are those of another machine.
    void choices() {
        line(0, "\nchoices, from the fastest to the smallest; the first that fits is taken");
        const double fastest = std::max(plan_.weighed.front().work, 1e-9);  // of nothing at all: 0
        std::string before;
        for (const Weighed& w : plan_.weighed) {
            const bool is_it = w.memory_bytes == plan_.memory_bytes;
            if (!is_it && memory_text(w.memory_bytes) == before) continue;
            before = memory_text(w.memory_bytes);
            line(0, fmt::format("{} {:>6} of memory, work {:4.2f}: {}, {}, tiles of {} × {}, {} at once",
                                is_it ? '*' : ' ', memory_text(w.memory_bytes), w.work / fastest,
                                w.keep_sources ? "decode once" : "decode again",
                                w.keep_computed ? "compute once" : "compute again", w.tile_width,
                                w.tile_height, counted(static_cast<std::size_t>(w.rows_ahead), "row")));
        }
    }

    const Plan& plan_;
    std::string text_;
};

}  // namespace

std::string Plan::text() const { return PlanText(*this).text(); }

}  // namespace keyline
