// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/graphs/streams.h"

#include "cli/common/table.h"
#include "cli/common/window_json.h"
#include "engine/base/channels.h"
#include "engine/base/index.h"
#include "engine/base/text.h"

#include <fmt/format.h>
#include <vector>

namespace keyline::cli {

namespace {

// As a file keeps the samples, or that they are made by a node.
const char* kind_of(const ResolvedFrame& frame, ValueRef value) {
    const std::optional<SampleType> stored = frame.info(value).stored;
    return stored ? sample_type_name(*stored) : "computed";
}

// "R G B A half, Depth: Z float": what stands together with one layer and one kind.
std::string channels_of(const ResolvedFrame& frame, const Stream& stream) {
    if (stream.is_data()) return "data: " + stream.data;
    std::string out, layer, kind;
    for (const std::size_t i : rgba_order(stream.names())) {
        const StreamChannel& c = stream.channels[i];
        const ChannelName name = split_channel(c.name);
        const bool goes_on = !out.empty() && name.layer == layer && kind == kind_of(frame, c.value);
        if (!goes_on) {
            if (!out.empty()) out += kind + ", ";
            layer = name.layer;
            kind = kind_of(frame, c.value);
            if (!layer.empty()) out += layer + ": ";
        }
        out += std::string(name.base) + " ";
    }
    return escaped(out + kind);
}

Row row_of(const Graph& graph, const ResolvedFrame& frame, const NodeStream& s) {
    const GraphNode& node = graph.nodes()[index(s.node)];
    return {node.id,
            node.type->name,
            to_string(s.stream.display),
            to_string(s.stream.window),
            to_string(s.digest),
            channels_of(frame, s.stream)};
}

}  // namespace

std::string streams_text(const Graph& graph, const ResolvedFrame& frame) {
    std::vector<Row> rows{{"node", "type", "display", "data", "digest", "channels"}};
    for (const NodeStream& s : frame.streams) rows.push_back(row_of(graph, frame, s));
    return fmt::format("frame {}\n", frame.frame) + table(rows);
}

void write_streams(JsonWriter& json, const Graph& graph, const ResolvedFrame& frame) {
    json.begin_object().field("frame", frame.frame).key("nodes").begin_array();
    for (const NodeStream& s : frame.streams) {
        const GraphNode& node = graph.nodes()[index(s.node)];
        json.begin_object().field("id", node.id).field("type", node.type->name);
        write_window(json, "displayWindow", s.stream.display);
        write_window(json, "dataWindow", s.stream.window);
        json.field("digest", to_string(s.digest));
        json.field("kind", s.stream.is_data() ? "data" : "pixels");
        if (s.stream.is_data()) json.field("data", s.stream.data);
        json.key("channels").begin_array();
        for (const StreamChannel& c : s.stream.channels) {
            const Op& op = frame.ops[index(c.value.op)];
            json.begin_object().field("name", c.name).field("type", kind_of(frame, c.value));
            write_window(json, "window", frame.info(c.value).window);
            json.field("madeBy", graph.nodes()[index(op.node)].id);
            json.field("digest", to_string(op.digest)).field("output", c.value.output).end_object();
        }
        json.end_array().end_object();
    }
    json.end_array().end_object();
}

}  // namespace keyline::cli
