// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/base/text.h"

#include "engine/base/index.h"
#include "engine/base/print.h"
#include "engine/io/describe.h"
#include "engine/plan/memory.h"
#include "engine/plan/plan.h"

#include <algorithm>
#include <fmt/format.h>
#include <string_view>

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
            if (op.source && plan_.demand.needs(place_of(op))) input(op);
        for (const Op& op : plan_.frame.ops)
            if (op.derivation && !op.derivation->file().empty() && plan_.demand.needs(place_of(op)))
                data_input(op);
        for (const Sink& sink : plan_.frame.sinks)
            sink.request.stream.is_data() ? data_output(sink) : output(sink);
        if (is_made_before(0)) {
            line(0, "\nbefore the first sweep");
            make_data(0);
        }
        for (std::size_t i = 0; i < plan_.sweeps.size(); ++i) sweep(i);
        carried();
        if (!plan_.weighed.empty()) choices();
        return std::move(text_);
    }

private:
    // Names that others gave may hold what a terminal obeys.
    void line(int indent, std::string_view text) {
        if (text.starts_with('\n')) text_ += '\n';
        text.remove_prefix(text.starts_with('\n') ? 1 : 0);
        text_ += std::string(static_cast<std::size_t>(2 * indent), ' ') + escaped(text) + "\n";
    }
    void entry(const char* label, const std::string& text) { line(1, fmt::format("{:<9}{}", label, text)); }

    std::size_t place_of(const Op& op) const {
        return static_cast<std::size_t>(&op - plan_.frame.ops.data());
    }
    const Op& op(int i) const { return plan_.frame.ops[index(i)]; }
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
        const int i = static_cast<int>(place_of(source));
        std::vector<ValueRef> read;
        for (int o = 0; o < static_cast<int>(source.outputs.size()); ++o)
            if (!plan_.demand.of({i, o}).empty()) read.push_back({i, o});
        const ImageHeader& header = source.source->header();
        line(0, fmt::format("\ninput {}, {}", file_of(i), source.title));
        if (source.frame != plan_.frame.frame) entry("frame", std::to_string(source.frame));
        entry("display", to_string(header.display_window));
        entry("data", to_string(header.data_window));
        entry("reads", fmt::format("{} of {}: {}", read.size(), counted(source.outputs.size(), "channel"),
                                   channels_of(read)));
        entry("region", to_string(plan_.demand.region(place_of(source))));
    }

    // What is there of earlier frames, what of it this one uses, and what it adds; a line each.
    void carried() {
        const std::size_t left = plan_.carried_bytes();
        if (plan_.carrying.held.empty() && left == 0) return;
        line(0, fmt::format("\ncarried from frame to frame: {} from earlier ones, {} more to later ones",
                            memory_text(plan_.carrying.held_bytes()), memory_text(left)));
        for (std::size_t i = 0; i < plan_.carrying.held.size(); ++i) {
            const Carried& held = plan_.carrying.held[i];
            const auto is_it = [&](const auto& found) { return found.second.held == i; };
            entry(std::ranges::any_of(plan_.carrying.found, is_it) ? "use" : "hold", told(held));
        }
        for (const Carried& held : to_hand_on(plan_)) entry("leave", told(held));
    }

    static std::string told(const Carried& held) {
        return fmt::format("{}, {}, until frame {}", held.title, memory_text(held.bytes), held.until);
    }

    void output(const Sink& sink) {
        line(0, fmt::format("\noutput {}, {}", file_of(sink), sink.title));
        entry("display", to_string(sink.request.spec.display_window));
        entry("data", to_string(sink.request.spec.data_window));
        entry("writes", describe(sink.request.spec.channels));
    }

    void data_input(const Op& source) {
        line(0, fmt::format("\ninput {}, {}", source.derivation->file().lexically_normal().string(),
                            source.title));
        entry("reads", source.derivation->gives());
    }

    void data_output(const Sink& sink) {
        line(0, fmt::format("\noutput {}, {}", file_of(sink), sink.title));
        entry("writes",
              fmt::format("{} of {}", sink.request.stream.data, op(sink.request.stream.datum.op).title));
    }

    bool is_made_before(int sweep) const {
        return std::ranges::any_of(plan_.data, [&](const PlannedDatum& d) { return d.made_before == sweep; });
    }

    // The data that are there when a sweep begins, and for how long.
    void make_data(int sweep) {
        const int sweeps = static_cast<int>(plan_.sweeps.size());
        for (const PlannedDatum& d : plan_.data) {
            if (d.made_before != sweep) continue;
            const Op& o = op(d.op);
            std::string text = fmt::format("{} of {}, {}", o.outputs[0].data, o.title, memory_text(d.bytes));
            if (d.carry_until)
                text += fmt::format(", until frame {}", *d.carry_until);
            else if (d.last_sweep >= sweeps)
                text += ", until written";
            else if (d.last_sweep >= sweep)
                text += fmt::format(", until sweep {}", d.last_sweep + 1);
            entry("make", text);
        }
    }

    void sweep(std::size_t i) {
        const Sweep& s = plan_.sweeps[i];
        line(0, fmt::format("\nsweep {} of {}: {}, {} of {} × {}, {} of memory", i + 1, plan_.sweeps.size(),
                            to_string(s.area), counted(s.columns.size() * s.rows.size(), "tile"),
                            s.tile_width, s.tile_height, memory_text(s.memory_bytes)));
        for (const int store : s.reads) decode(plan_.stores[index(store)], i);
        steps(s);
        for (const Root& root : s.roots) leave(root);
        make_data(static_cast<int>(i) + 1);
    }

    void decode(const Store& store, std::size_t sweep) {
        std::string text = fmt::format("{}, {}: {}", file_of(store.source_op), to_string(store.region),
                                       channels_of(store.values));
        if (store.carry_until)
            text += fmt::format("; kept, {}, until frame {}", memory_text(store.bytes()), *store.carry_until);
        else if (store.last_sweep > static_cast<int>(sweep))
            text +=
                fmt::format("; kept, {}, until sweep {}", memory_text(store.bytes()), store.last_sweep + 1);
        entry("decode", text);
    }

    // What a step does to whom.  A node that works channel by channel is one line, not one a channel.
    std::pair<const char*, std::string> told(const Step& step) const {
        const Op& o = op(step.op);
        if (step.kind == Step::Kind::kLoad) {
            if (o.source) return {"", ""};  // decoding was told
            const bool is_held = plan_.stores[index(step.store)].held >= 0;
            return {"load", o.title + (is_held ? ", from an earlier frame" : ", kept from an earlier sweep")};
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
                return entry("gather", fmt::format("{}, from {}", op(root.op).title, to_string(root.region)));
            case Root::Kind::kKeep: {
                const Store& store = plan_.stores[index(root.store)];
                const std::string until = store.carry_until ? fmt::format("frame {}", *store.carry_until)
                                                            : fmt::format("sweep {}", store.last_sweep + 1);
                return entry("keep", fmt::format("{}, {}, {}, until {}", op(store.values.front().op).title,
                                                 to_string(store.region), memory_text(store.bytes()), until));
            }
            case Root::Kind::kSink: break;
        }
        const Sink& sink = plan_.frame.sinks[index(root.sink)];
        const auto untouched = std::ranges::count(root.untouched, true);
        std::string text = fmt::format("{}, {}", file_of(sink), counted(root.operands.size(), "channel"));
        if (untouched > 0) text += fmt::format(", {} as they are in the input", untouched);
        entry("write", text);
    }

    // Time is told against the first's: the model's seconds are those of another machine.
    void choices() {
        line(0, "\nchoices, from the roomiest to the smallest; the first that fits is taken");
        const double fastest = std::max(plan_.weighed.front().seconds, 1e-9);  // of nothing at all: 0
        std::string before;
        for (const Weighed& w : plan_.weighed) {
            const bool is_it = w.memory_bytes == plan_.memory_bytes;
            if (!is_it && memory_text(w.memory_bytes) == before) continue;
            before = memory_text(w.memory_bytes);
            line(0, fmt::format("{} {:>6} of memory, time {:4.2f}: {}, {}, {}tiles of {} × {}, {} at once",
                                is_it ? '*' : ' ', memory_text(w.memory_bytes), w.seconds / fastest,
                                w.keep_sources ? "decode once" : "decode again",
                                w.keep_computed ? "compute once" : "compute again",
                                w.carry ? "carry on, " : "", w.tile_width, w.tile_height,
                                counted(static_cast<std::size_t>(w.rows_ahead), "row")));
        }
    }

    const Plan& plan_;
    std::string text_;
};

}  // namespace

std::string Plan::text() const { return PlanText(*this).text(); }

}  // namespace keyline
