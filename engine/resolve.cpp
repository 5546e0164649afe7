// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/resolve.h"

#include "engine/channels.h"
#include "engine/io/color.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <map>

namespace keyline {

namespace {

// Thrown to leave a node whose input already failed and was reported.
struct AlreadyReported {};

class Copy final : public Operation {
public:
    void compute(const Inputs& in, Outputs out, Scratch&) const override {
        const View& from = in[Input{{}, {}, {}, 0}][0];
        const auto bytes = static_cast<std::size_t>(out[0].rect.width()) * sizeof(float);
        for (int y = out[0].rect.y0; y < out[0].rect.y1; ++y) std::memcpy(out[0].row(y), from.row(y), bytes);
    }
    double cost() const override { return 1; }
};

class Resolver {
public:
    Resolver(const Graph& graph, int frame, const ResolveOptions& options, Diagnostics& diagnostics)
        : graph_(graph), options_(options), diagnostics_(diagnostics) {
        result_.frame = frame;
    }

    // In dependency order, so that no chain of nodes is too long for the stack.
    std::optional<ResolvedFrame> run() {
        const std::vector<bool> wanted = wanted_nodes();
        for (const int node : graph_.order())
            if (wanted[static_cast<std::size_t>(node)]) resolve_quietly(node);
        if (!diagnostics_.ok()) return std::nullopt;
        return std::move(result_);
    }

    // The stream of a node at a frame, resolved once.
    const Stream& stream(int node, int frame) {
        const auto key = std::pair(node, frame);
        if (const auto it = streams_.find(key); it != streams_.end()) {
            if (!it->second) throw AlreadyReported{};
            return *it->second;
        }
        std::optional<Stream>& slot = streams_[key];
        slot = resolve_node(node, frame);
        if (!slot) throw AlreadyReported{};
        return *slot;
    }

private:
    friend class NodeBuilder;

    std::vector<bool> wanted_nodes() const {
        std::vector<bool> wanted(graph_.nodes().size(), false);
        for (const int sink : graph_.sinks()) wanted[static_cast<std::size_t>(sink)] = true;
        for (auto it = graph_.order().rbegin(); it != graph_.order().rend(); ++it) {
            const auto node = static_cast<std::size_t>(*it);
            if (options_.every_node && graph_.nodes()[node].type->kind != NodeKind::kSink)
                wanted[node] = true;
            if (wanted[node])
                for (const int target : graph_.links(*it)) wanted[static_cast<std::size_t>(target)] = true;
        }
        return wanted;
    }

    void resolve_quietly(int node) {
        try {
            stream(node, result_.frame);
        } catch (const AlreadyReported&) {
        }
    }

    const Node* node_at(int node, int frame) {
        auto it = nodes_.find(frame);
        if (it == nodes_.end()) {
            Diagnostics told;
            it = nodes_.emplace(frame, graph_.at(frame, options_.faults_told ? told : diagnostics_)).first;
        }
        return it->second[static_cast<std::size_t>(node)].get();
    }

    bool is_sink(int node) const {
        return graph_.nodes()[static_cast<std::size_t>(node)].type->kind == NodeKind::kSink;
    }

    const ColorConfig& colors() {
        if (!colors_)
            colors_ = options_.ocio.empty() ? ColorConfig::builtin() : ColorConfig::load(options_.ocio);
        return *colors_;
    }

    std::optional<Stream> resolve_node(int node, int frame);

    const Graph& graph_;
    const ResolveOptions& options_;
    Diagnostics& diagnostics_;
    ResolvedFrame result_;
    std::map<int, FrameNodes> nodes_;                               // by frame
    std::map<std::pair<int, int>, std::optional<Stream>> streams_;  // by node and frame; nothing: it failed
    std::shared_ptr<const ColorConfig> colors_;
};

// What one node sees while it is resolved for one frame.
class NodeBuilder final : public Builder {
public:
    NodeBuilder(Resolver& resolver, const GraphNode& node, int frame)
        : resolver_(resolver), node_(node), frame_(frame) {}

    int frame() const override { return frame_; }
    const ColorConfig& colors() override { return resolver_.colors(); }

    Stream input(const Input& in, int frame) override {
        const int from = resolver_.graph_.index_of(in.node);
        if (from < 0 || resolver_.is_sink(from)) throw AlreadyReported{};
        const Stream& whole = resolver_.stream(from, frame);
        last_place_ = in.place;
        return in.selector.empty() ? whole : select(whole, in);
    }

    std::vector<ValueRef> add(std::shared_ptr<const Operation> operation, std::vector<Link> links,
                              const Rect& window, int outputs) override {
        Op op;
        op.operation = std::move(operation);
        op.links = std::move(links);
        op.outputs.assign(static_cast<std::size_t>(outputs), {window, std::nullopt});
        return add_op(std::move(op));
    }

    Stream add_source(std::shared_ptr<const ImageSource> source) override {
        Stream stream;
        const ImageHeader& header = source->header();
        stream.display = header.display_window;
        stream.window = header.data_window;
        stream.metadata = std::make_shared<Metadata>(header.metadata);
        stream.file = header.file;
        Op op;
        for (std::size_t g = 0; g < header.groups.size(); ++g)
            for (std::size_t c = 0; c < header.groups[g].channels.size(); ++c) {
                const ChannelInfo& channel = header.groups[g].channels[c];
                op.outputs.push_back({header.groups[g].window, channel.type});
                op.source_group.push_back(g);
                op.source_channel.push_back(c);
                stream.channels.push_back({channel.name, {}});
            }
        op.source = std::move(source);
        const std::vector<ValueRef> values = add_op(std::move(op));
        for (std::size_t i = 0; i < values.size(); ++i) stream.channels[i].value = values[i];
        return stream;
    }

    void add_sink(SinkRequest request) override {
        if (resolver_.options_.check_formats) check_format(request);
        resolver_.result_.sinks.push_back({title(), node_.place, std::move(request)});
    }

    ValueRef clip(ValueRef value, const Rect& window) override {
        const ValueInfo info = resolver_.result_.info(value);
        if (window.contains(info.window)) return value;
        Op op;
        op.operation = std::make_shared<const Copy>();
        op.links.push_back({window, {value}});
        op.outputs.push_back({intersect(window, info.window), info.stored});
        return add_op(std::move(op)).front();
    }

    std::optional<SampleType> stored_type(ValueRef value) const override {
        return resolver_.result_.info(value).stored;
    }

    bool leaves_out_identities() const override { return resolver_.options_.leave_out_identities; }

    void warn(std::string what) override {
        resolver_.diagnostics_.warning({ErrorKind::kFailed, {}, title(), std::move(what), {}});
    }

    void bad_parameter(const char* name, std::string what, std::string hint) override {
        const Value* v = node_.object.find(name);
        throw Failure(
            {ErrorKind::kGraph, v ? v->place : node_.place, title(), std::move(what), std::move(hint)});
    }

    // What a failure inside the node is completed with.
    std::string title() const { return node_.title(); }
    const Place& place() const { return last_place_ ? *last_place_ : node_.place; }

    // Where the node's file stands, for what is wrong with that.
    const Place& file_place() const {
        for (const FieldInfo& f : node_.type->fields)
            if (const Value* v = node_.object.find(f.name); v && f.type.kind == TypeInfo::Kind::kFile)
                return v->place;
        return place();
    }

private:
    void check_format(const SinkRequest& request) {
        try {
            if (request.check) request.check(request.spec);
        } catch (const Failure& f) {
            Error e = f.error();
            e.place = node_.place;
            e.node = title();
            resolver_.diagnostics_.error(std::move(e));
        }
    }

    Stream select(const Stream& whole, const Input& in) {
        Stream out = whole;
        out.channels.clear();
        for (const Picked& s : select_channels(whole.names(), in.selector))
            out.channels.push_back({s.name, whole.channels[s.index].value});
        return out;
    }

    std::vector<ValueRef> add_op(Op op) {
        op.title = title();
        op.frame = frame_;
        const int index = static_cast<int>(resolver_.result_.ops.size());
        std::vector<ValueRef> values;
        for (int i = 0; i < static_cast<int>(op.outputs.size()); ++i) values.push_back({index, i});
        resolver_.result_.ops.push_back(std::move(op));
        return values;
    }

    Resolver& resolver_;
    const GraphNode& node_;
    int frame_;
    std::optional<Place> last_place_;
};

std::optional<Stream> Resolver::resolve_node(int node, int frame) {
    const GraphNode& graph_node = graph_.nodes()[static_cast<std::size_t>(node)];
    const Node* parsed = node_at(node, frame);
    if (!parsed) return std::nullopt;
    NodeBuilder builder(*this, graph_node, frame);
    try {
        return parsed->resolve(builder);
    } catch (const Failure& f) {
        Error e = f.error();
        if (e.place.file.empty())
            e.place = e.kind == ErrorKind::kInput ? builder.file_place() : builder.place();
        if (options_.known_sound && e.kind == ErrorKind::kGraph) e.kind = ErrorKind::kInput;
        if (e.node.empty()) e.node = builder.title();
        diagnostics_.error(std::move(e));
    } catch (const AlreadyReported&) {
    }
    return std::nullopt;
}

}  // namespace

std::optional<ResolvedFrame> resolve(const Graph& graph, int frame, const ResolveOptions& options,
                                     Diagnostics& diagnostics) {
    return Resolver(graph, frame, options, diagnostics).run();
}

}  // namespace keyline
