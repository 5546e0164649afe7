// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/graphs/plan_json.h"

#include "engine/base/index.h"

#include <algorithm>
#include <string>

namespace keyline::cli {

namespace {

class PlanJson {
public:
    PlanJson(JsonWriter& json, const Plan& plan) : json_(json), plan_(plan) {}

    void write() {
        json_.begin_object().field("frame", plan_.frame.frame).field("threads", plan_.threads);
        json_.field("memory", plan_.memory_bytes).field("rowsAtOnce", plan_.rows_ahead);
        json_.key("inputs").begin_array();
        for (std::size_t i = 0; i < plan_.frame.ops.size(); ++i)
            if (plan_.frame.ops[i].source && plan_.demand.needs(i)) input(i);
        json_.end_array().key("outputs").begin_array();
        for (const Sink& sink : plan_.frame.sinks) output(sink);
        json_.end_array().key("sweeps").begin_array();
        for (const Sweep& s : plan_.sweeps) sweep(s);
        json_.end_array().key("carried").begin_array();
        for (const Carried& h : plan_.carrying.held) carried("held", h);
        for (const Carried& h : to_hand_on(plan_)) carried("left", h);
        json_.end_array().key("choices").begin_array();
        for (const Weighed& w : plan_.weighed) choice(w);
        json_.end_array().end_object();
    }

private:
    void window(const char* name, const Rect& r) {
        json_.key(name).begin_object().field("x", r.x0).field("y", r.y0);
        json_.field("width", r.width()).field("height", r.height()).end_object();
    }

    void channel(const ChannelInfo& c) {
        json_.begin_object().field("name", c.name).field("type", sample_type_name(c.type)).end_object();
    }

    const Op& op(int i) const { return plan_.frame.ops[index(i)]; }

    const ChannelInfo& source_channel(ValueRef v) const {
        const Op& source = op(v.op);
        const auto which = static_cast<std::size_t>(v.output);
        return source.source->header()
            .groups[source.source_group[which]]
            .channels[source.source_channel[which]];
    }

    void input(std::size_t index) {
        const Op& source = plan_.frame.ops[index];
        const ImageHeader& header = source.source->header();
        json_.begin_object().field("file", header.file.string()).field("node", source.title);
        json_.field("frame", source.frame);
        window("displayWindow", header.display_window);
        window("dataWindow", header.data_window);
        window("region", plan_.demand.region(index));
        json_.key("reads").begin_array();
        for (int o = 0; o < static_cast<int>(source.outputs.size()); ++o) {
            const ValueRef v{static_cast<int>(index), o};
            if (!plan_.demand.of(v).empty()) channel(source_channel(v));
        }
        json_.end_array().field("channels", source.outputs.size()).end_object();
    }

    // From an earlier frame, or for a later one.
    void carried(const char* what, const Carried& held) {
        json_.begin_object().field("what", what).field("of", held.title);
        json_.field("bytes", held.bytes).field("untilFrame", held.until).end_object();
    }

    void output(const Sink& sink) {
        const SinkSpec& spec = sink.request.spec;
        json_.begin_object().field("file", sink.request.file.string()).field("node", sink.title);
        if (sink.request.stream.is_data()) {
            json_.field("data", std::string(sink.request.stream.data)).end_object();
            return;
        }
        window("displayWindow", spec.display_window);
        window("dataWindow", spec.data_window);
        json_.key("writes").begin_array();
        for (const ChannelInfo& c : spec.channels) channel(c);
        json_.end_array().end_object();
    }

    void sweep(const Sweep& s) {
        json_.begin_object();
        window("region", s.area);
        json_.field("tiles", s.columns.size() * s.rows.size());
        json_.field("tileWidth", s.tile_width).field("tileHeight", s.tile_height);
        json_.field("memory", s.memory_bytes).key("decodes").begin_array();
        for (const int i : s.reads) decoded(plan_.stores[index(i)]);
        json_.end_array().key("steps").begin_array();
        for (const Step& step : s.steps) computed(step);
        json_.end_array().key("leaves").begin_array();
        for (const Root& root : s.roots) leaves(root);
        json_.end_array().end_object();
    }

    void until(const Store& store) {
        if (store.carry_until)
            json_.field("untilFrame", *store.carry_until);
        else
            json_.field("untilSweep", store.last_sweep + 1);
    }

    void decoded(const Store& store) {
        json_.begin_object().field("file", op(store.source_op).source->header().file.string());
        window("region", store.region);
        json_.key("channels").begin_array();
        for (const ValueRef v : store.values) channel(source_channel(v));
        json_.end_array();
        until(store);
        json_.field("bytes", store.bytes()).end_object();
    }

    // What is decoded was told.
    void computed(const Step& step) {
        const bool is_load = step.kind == Step::Kind::kLoad;
        if (is_load && op(step.op).source) return;
        const char* what = is_load ? "load" : "compute";
        json_.begin_object().field("what", what).field("node", op(step.op).title).end_object();
    }

    void leaves(const Root& root) {
        json_.begin_object();
        switch (root.kind) {
            case Root::Kind::kMap: json_.field("what", "gather").field("node", op(root.op).title); break;
            case Root::Kind::kKeep: {
                const Store& store = plan_.stores[index(root.store)];
                json_.field("what", "keep").field("node", op(root.op).title);
                until(store);
                json_.field("bytes", store.bytes());
                break;
            }
            case Root::Kind::kSink: {
                const Sink& sink = plan_.frame.sinks[index(root.sink)];
                json_.field("what", "write")
                    .field("node", sink.title)
                    .field("file", sink.request.file.string());
                json_.field("channels", root.operands.size());
                json_.field("untouched", std::ranges::count(root.untouched, true));
                break;
            }
        }
        window("region", root.region);
        json_.end_object();
    }

    // Time is told against the first's, as in the text.
    void choice(const Weighed& w) {
        const double first = std::max(plan_.weighed.front().seconds, 1e-9);
        json_.begin_object().field("memory", w.memory_bytes).field("time", w.seconds / first);
        json_.field("decodesOnce", w.keep_sources).field("computesOnce", w.keep_computed);
        json_.field("carries", w.carry);
        json_.field("tileWidth", w.tile_width).field("tileHeight", w.tile_height);
        json_.field("rowsAtOnce", w.rows_ahead).field("taken", w.memory_bytes == plan_.memory_bytes);
        json_.end_object();
    }

    JsonWriter& json_;
    const Plan& plan_;
};

}  // namespace

void write_plan(JsonWriter& json, const Plan& plan) { PlanJson(json, plan).write(); }

}  // namespace keyline::cli
