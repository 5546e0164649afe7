// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/plan/resolve.h"

#include "engine/base/absent_input.h"
#include "engine/base/bad_value.h"
#include "engine/base/channels.h"
#include "engine/base/index.h"
#include "engine/base/pixel_aspect.h"
#include "engine/color/color.h"
#include "engine/io/file_identity.h"
#include "engine/node/parts.h"
#include "engine/plan/stream_digest.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <map>
#include <utility>

namespace keyline {

namespace {

// Thrown to leave a node whose input already failed and was reported.
struct AlreadyReported {};

class Copy final : public Operation {
public:
    void compute(const Inputs& in, Outputs out, Scratch&) const override {
        const View& from = in.slot(0)[0];
        const auto bytes = static_cast<std::size_t>(out[0].rect.width()) * sizeof(float);
        for (int y = out[0].rect.y0; y < out[0].rect.y1; ++y) std::memcpy(out[0].row(y), from.row(y), bytes);
    }
    double cost() const override { return 1; }
};

// Thrown to leave a node that asks for a stream which is not there yet.  The node is begun again afterwards,
// so that no chain of nodes through other frames is too long for the stack.
struct NotYet {
    int node, frame;
};

class Resolver {
public:
    Resolver(const Graph& graph, int frame, const ResolveOptions& options, Diagnostics& diagnostics)
        : graph_(graph),
          options_(options),
          diagnostics_(diagnostics),
          session_(options.session ? options.session : std::make_shared<Session>()) {
        result_.frame = frame;
    }

    // In dependency order.
    std::optional<ResolvedFrame> run() {
        const std::vector<bool> wanted = wanted_nodes();
        for (const int node : graph_.order())
            if (wanted[index(node)]) settle(node);
        if (!diagnostics_.ok()) return std::nullopt;
        if (options_.every_node) tell_streams();
        for (const auto& [at, parsed] : nodes_)
            if (parsed) result_.nodes.push_back({at.first, at.second, parsed});
        return std::move(result_);
    }

    // The stream of a node at a frame, resolved once.
    const Stream& stream(int node, int frame) const {
        const auto it = streams_.find({node, frame});
        if (it == streams_.end()) throw NotYet{node, frame};
        if (!it->second) throw AlreadyReported{};
        return *it->second;
    }

private:
    friend class NodeBuilder;

    std::vector<bool> wanted_nodes() const {
        std::vector<bool> wanted(graph_.nodes().size(), false);
        for (const int sink : graph_.sinks()) wanted[index(sink)] = true;
        for (auto it = graph_.order().rbegin(); it != graph_.order().rend(); ++it) {
            const auto node = static_cast<std::size_t>(*it);
            if (options_.every_node && is_looked_at(graph_.nodes()[node])) wanted[node] = true;
            if (!wanted[node]) continue;
            for (const int target : links(*it)) wanted[static_cast<std::size_t>(target)] = true;
        }
        return wanted;
    }

    // Also where nothing that is written uses it.  What a group has and nobody asks for is nobody's fault.
    static bool is_looked_at(const GraphNode& node) {
        return node.type->kind != NodeKind::kSink && !node.scope->outer;
    }

    // What a node reads: nothing but what it passes on, where it is not enabled.
    std::vector<int> links(int node) const {
        if (is_enabled(node, result_.frame)) return graph_.links(node);
        const auto leading = is_sink(node) ? std::nullopt : graph_.leading_input(node, result_.frame);
        const int from = leading ? graph_.index_of(leading->node) : -1;
        return from < 0 ? std::vector<int>{} : std::vector{from};
    }

    static bool is_open(const std::vector<NotYet>& open, const NotYet& wanted) {
        return std::ranges::any_of(
            open, [&](const NotYet& o) { return o.node == wanted.node && o.frame == wanted.frame; });
    }

    // Resolves a node of this frame after what it asks for in others.
    void settle(int node) {
        std::vector<NotYet> open{{node, result_.frame}};
        while (!open.empty()) {
            const NotYet next = open.back();
            if (!streams_.contains({next.node, next.frame})) {
                try {
                    streams_[{next.node, next.frame}] = resolve_node(next.node, next.frame);
                } catch (const NotYet& before) {
                    if (!is_open(open, before)) {
                        open.push_back(before);
                        continue;
                    }
                    streams_[{next.node, next.frame}] = std::nullopt;  // a cycle; the loader told it
                }
            }
            open.pop_back();
        }
    }

    const Node* node_at(int node, int frame) {
        const auto known = nodes_.find({node, frame});
        if (known != nodes_.end()) return known->second.get();
        const std::optional<InputSizes> sizes = sizes_for(node, frame);
        auto parsed = graph_.at(node, frame, faults_of_graph(), sizes ? &*sizes : nullptr);
        return nodes_.emplace(NodeOfFrame{node, frame}, std::move(parsed)).first->second.get();
    }

    Diagnostics& faults_of_graph() { return options_.faults_told ? told_ : diagnostics_; }

    // Of the leading input, where a parameter depends on them.
    std::optional<InputSizes> sizes_for(int node, int frame) const {
        if (!graph_.uses_sizes(node)) return std::nullopt;
        const std::optional<Input> leading = graph_.leading_input(node, frame);
        const int from = leading ? graph_.index_of(leading->node) : -1;
        if (from < 0 || is_sink(from)) throw AlreadyReported{};
        const Stream& in = stream(from, frame);
        return InputSizes{in.display, in.window, in.metadata ? pixel_aspect(*in.metadata) : 1.0};
    }

    bool is_enabled(int node, int frame) const {
        Diagnostics told;  // by the loader, and where the node is resolved
        return graph_.is_enabled(node, frame, told).value_or(true);
    }

    bool is_sink(int node) const { return graph_.nodes()[index(node)].type->kind == NodeKind::kSink; }

    const ColorConfig& colors() {
        if (!colors_) colors_ = session_->colors(options_.ocio);
        return *colors_;
    }

    void tell_streams() {
        for (const int node : graph_.order()) {
            const auto it = streams_.find({node, result_.frame});
            if (it == streams_.end() || is_sink(node)) continue;
            std::vector<Digest> values;
            for (const StreamChannel& c : it->second->channels) values.push_back(digest_of_value(c.value));
            if (it->second->is_data()) values.push_back(digest_of_value(it->second->datum));
            const Stream& stream = *it->second;
            result_.streams.push_back(
                {node, stream, digest_of(stream, metadata_digest(stream.metadata), values)});
        }
    }

    Digest digest_of_value(ValueRef v) const {
        const Digest& op = result_.ops[index(v.op)].digest;
        return Digester("value").add(op).add(v.output).digest();
    }

    // Streams pass their metadata on; manifests in it can be long.
    const Digest& metadata_digest(const std::shared_ptr<const Metadata>& metadata) {
        const auto [it, is_new] = metadata_.try_emplace(metadata);
        if (is_new) it->second = digest_of(*metadata);
        return it->second;
    }

    std::optional<Stream> resolve_node(int node, int frame);

    using NodeOfFrame = std::pair<int, int>;
    const Graph& graph_;
    const ResolveOptions& options_;
    Diagnostics& diagnostics_;
    Diagnostics told_;  // what the loader told already
    const std::shared_ptr<Session> session_;
    ResolvedFrame result_;
    std::map<NodeOfFrame, std::shared_ptr<const Node>> nodes_;
    std::map<NodeOfFrame, std::optional<Stream>> streams_;  // nothing: it failed
    std::map<std::shared_ptr<const Metadata>, Digest> metadata_;
    std::shared_ptr<const ColorConfig> colors_;
};

// What one node sees while it is resolved for one frame.
class NodeBuilder final : public Builder {
public:
    NodeBuilder(Resolver& resolver, int node, int frame, const Node& parsed)
        : resolver_(resolver),
          index_(node),
          node_(resolver.graph_.nodes()[index(node)]),
          frame_(frame),
          parsed_(parsed),
          first_op_(resolver.result_.ops.size()),
          first_sink_(resolver.result_.sinks.size()) {
        asked_.add(digest_of(*node_.type, parsed));
    }

    int frame() const override {
        if (!std::exchange(asked_frame_, true)) asked_.add("frame").add(frame_);
        return frame_;
    }

    // A config that can't be loaded is told at the node, whichever of its inputs it has asked for: compilers
    // evaluate the arguments of a call in orders of their own.
    const ColorConfig& colors() override {
        try {
            const ColorConfig& colors = resolver_.colors();
            resolver_.result_.nodes_with_colours.insert(index_);
            asked_.add(colors.digest());
            return colors;
        } catch (const Failure& f) {
            rethrow_with(f, [&](Error& e) {
                if (e.place.file.empty()) e.place = node_.place;
            });
        }
    }

    std::shared_ptr<const ColorConfig> colors(const Map<std::string>& variables) override {
        const std::shared_ptr<const ColorConfig> config = colors().in_context(variables.entries);
        asked_.add(config->digest());
        return config;
    }

    Stream input(const Input& in) override { return input(in, frame_); }

    Stream input(const Input& in, int frame) override {
        const int from = resolver_.graph_.index_of(in.node);
        if (from < 0 || resolver_.is_sink(from)) throw AlreadyReported{};
        const Stream& whole = resolver_.stream(from, frame);
        last_place_ = in.place;
        Stream stream = in.selector.empty() ? whole : whole.is_data() ? pick(whole, in) : select(whole, in);
        asked_.add(digest_of(stream, resolver_.metadata_digest(stream.metadata), {}));
        return stream;
    }

    std::shared_ptr<const ImageSource> open(const std::filesystem::path& file,
                                            const OpenOptions& options) override {
        resolver_.result_.inputs.push_back({index_, frame_, file, file_identity(file)});
        return resolver_.session_->open(file, options);
    }

    Digest file(const std::filesystem::path& file) override {
        const Digest identity = file_identity(file);
        resolver_.result_.inputs.push_back({index_, frame_, file, identity});
        asked_.add(identity);
        return identity;
    }

    std::vector<ValueRef> add(std::shared_ptr<const Operation> operation, std::vector<Link> links,
                              const Rect& window, int outputs) override {
        Op op;
        op.operation = std::move(operation);
        op.links = std::move(links);
        op.outputs.assign(static_cast<std::size_t>(outputs), {window});
        Digester digester("operation");
        digester.add(asked_.digest()).add(ordinal(op.operation.get()));
        return add_op(std::move(op), digester);
    }

    ValueRef add(std::shared_ptr<const Gather> gather, std::vector<Link> links, const Rect& window) override {
        Op op;
        op.outputs.push_back({window, std::nullopt, gather->gives()});
        op.gather = std::move(gather);
        op.links = std::move(links);
        Digester digester("gather");
        digester.add(asked_.digest()).add(ordinal(op.gather.get()));
        return add_op(std::move(op), digester).front();
    }

    ValueRef add(std::shared_ptr<const Derivation> derivation, std::vector<Link> links) override {
        Op op;
        op.outputs.push_back({{}, std::nullopt, derivation->gives()});
        Digester digester("derivation");
        if (!derivation->file().empty()) {
            const Digest identity = file_identity(derivation->file());
            resolver_.result_.inputs.push_back({index_, frame_, derivation->file(), identity});
            digester.add(identity);
        }
        digester.add(asked_.digest()).add(ordinal(derivation.get()));
        op.derivation = std::move(derivation);
        op.links = std::move(links);
        return add_op(std::move(op), digester).front();
    }

    using Builder::add_source;
    Stream add_source(std::shared_ptr<const ImageSource> given) override {
        std::shared_ptr<const ImageSource> source = resolver_.session_->shared(std::move(given));
        Stream stream;
        const ImageHeader& header = source->header();
        stream.display = header.display_window;
        stream.window = header.data_window;
        stream.metadata = std::make_shared<Metadata>(header.metadata);
        stream.file = header.file;
        std::vector<SampleType> types;
        Op op;
        for (std::size_t g = 0; g < header.groups.size(); ++g)
            for (std::size_t c = 0; c < header.groups[g].channels.size(); ++c) {
                const ChannelInfo& channel = header.groups[g].channels[c];
                op.outputs.push_back({header.groups[g].window, channel.type});
                op.source_group.push_back(g);
                op.source_channel.push_back(c);
                stream.channels.push_back({channel.name, {}});
                types.push_back(channel.type);
            }
        Digester digester("source");
        digester.add(source->digest());
        op.source = std::move(source);
        const std::vector<ValueRef> values = add_op(std::move(op), digester);
        for (std::size_t i = 0; i < values.size(); ++i) stream.channels[i].value = values[i];
        learn_channels(stream, types);
        return stream;
    }

    void add_sink(SinkRequest request) override {
        if (resolver_.options_.check_formats && !request.stream.is_data()) check_format(request);
        resolver_.result_.sinks.push_back({title(), node_.place, std::move(request), index_});
    }

    ValueRef clip(ValueRef value, const Rect& window) override {
        const ValueInfo info = resolver_.result_.info(value);
        if (window.contains(info.window)) return value;
        Op op;
        op.operation = std::make_shared<const Copy>();
        op.links.emplace_back(window, window, std::vector{value});
        op.outputs.push_back({intersect(window, info.window), info.stored});
        Digester digester("clip");
        return add_op(std::move(op), digester).front();
    }

    std::optional<SampleType> stored_type(ValueRef value) const override {
        const std::optional<SampleType> stored = resolver_.result_.info(value).stored;
        asked_.add(stored ? static_cast<int>(*stored) : -1);
        return stored;
    }

    bool leaves_out_identities() const override { return resolver_.options_.leave_out_identities; }

    void warn(std::string what) override {
        warnings_.push_back({ErrorKind::kFailed, node_.place, title(), std::move(what), {}});
    }

    // Told at the first frame: what a later one would say again is no news.
    void warn(Code mistake, std::string what, std::string hint) override {
        if (is_meant(mistake) || resolver_.options_.known_sound) return;
        hint += fmt::format("; \"meant\": \"{}\" says that it is right so", code_name(mistake));
        warnings_.push_back({ErrorKind::kGraph, node_.place, title(), std::move(what), std::move(hint),
                             Passing::kNever, mistake});
    }

    void bad_parameter(const char* name, std::string what, std::string hint) override {
        const Value* v = node_.object.find(name);
        throw Failure({ErrorKind::kGraph, v ? v->place : node_.place, title(), std::move(what),
                       std::move(hint), Passing::kNever, Code::kWrongValue});
    }

    // The node is whole: its warnings hold.
    void finish() {
        for (Error& w : warnings_) resolver_.diagnostics_.warning(std::move(w));
    }

    // It will be begun again: what it added is taken back.
    void take_back() {
        auto& ops = resolver_.result_.ops;
        auto& sinks = resolver_.result_.sinks;
        ops.erase(ops.begin() + static_cast<std::ptrdiff_t>(first_op_), ops.end());
        sinks.erase(sinks.begin() + static_cast<std::ptrdiff_t>(first_sink_), sinks.end());
    }

    // What a failure inside the node is completed with.
    std::string title() const { return node_.title(); }
    const Place& place() const { return last_place_ ? *last_place_ : node_.place; }

    // Where the parameter stands that has a value, or the item of one; the node's place where none has, as
    // for a default.  An input is no such value: what is wrong with one is told where it is read.
    const Place& place_of(const std::string& value) const {
        const Value parameters = parsed_.to_value();
        for (const FieldInfo& f : node_.type->fields) {
            const Value* parameter = parameters.find(f.name);
            const Value* given = node_.object.find(f.name);
            if (!parameter || !given || f.type.kind == TypeInfo::Kind::kInput) continue;
            if (const Place* place = place_in(*parameter, *given, value)) return *place;
        }
        return node_.place;
    }

    // Where the node's file stands, for what is wrong with that.
    const Place& file_place() const {
        for (const FieldInfo& f : node_.type->fields)
            if (const Value* v = node_.object.find(f.name); v && f.type.kind == TypeInfo::Kind::kFile)
                return v->place;
        return place();
    }

private:
    // `given` is the parameter as written, which may be a variable where this is a list.
    static const Place* place_in(const Value& parameter, const Value& given, const std::string& value) {
        if (parameter.is(Value::Kind::kString) && parameter.text == value) return &given.place;
        for (std::size_t i = 0; i < parameter.items.size(); ++i) {
            const Value& item = i < given.items.size() ? given.items[i] : given;
            if (const Place* place = place_in(parameter.items[i], item, value)) return place;
        }
        for (const Member& m : parameter.members) {
            const Value* member = given.find(m.key);
            if (const Place* place = place_in(m.value, member ? *member : given, value)) return place;
        }
        return nullptr;
    }

    bool is_meant(Code mistake) const {
        const auto names_it = [&](const std::vector<Code>& meant) {
            return std::ranges::find(meant, mistake) != meant.end();
        };
        if (names_it(node_.meant)) return true;
        for (const Scope* scope = node_.scope.get(); scope; scope = scope->outer)
            if (names_it(scope->meant)) return true;
        return false;
    }

    void check_format(const SinkRequest& request) {
        try {
            if (request.check) request.check(request.spec);
        } catch (const Failure& f) {
            Error e = f.error();
            const auto* bad = dynamic_cast<const BadValue*>(&f);
            e.place = bad ? place_of(bad->value()) : file_place();
            e.node = title();
            resolver_.diagnostics_.error(std::move(e));
        }
    }

    // Which of the parts was checked when the graph was loaded.
    Stream pick(const Stream& whole, const Input& in) {
        const DataParts& parts = *parts_of_kind(whole.data);
        asked_.add(in.selector);
        Stream out = whole;
        out.datum =
            add(std::make_shared<const PickPart>(whole.data, parts, find_part(parts, in.selector).value()),
                {Link(whole, {})});
        return out;
    }

    Stream select(const Stream& whole, const Input& in) {
        Stream out = whole;
        out.channels.clear();
        for (const Picked& s : select_channels(whole.names(), in.selector))
            out.set(s.name, whole.channels[s.index]);
        return out;
    }

    // Which of the node's operations this is; one that works channel by channel is the same for each.
    std::size_t ordinal(const void* operation) {
        const auto it = std::ranges::find(operations_, operation);
        if (it != operations_.end()) return static_cast<std::size_t>(it - operations_.begin());
        operations_.push_back(operation);
        return operations_.size() - 1;
    }

    // `digester` holds what the operation is; what it reads and makes is added.
    std::vector<ValueRef> add_op(Op op, Digester& digester) {
        const auto add = [&](const Rect& r) { digester.add(r.x0).add(r.y0).add(r.x1).add(r.y1); };
        for (const ValueInfo& info : op.outputs) {
            add(info.window);
            digester.add(info.stored ? static_cast<int>(*info.stored) : -1).add(info.data);
        }
        for (const Link& link : op.links) {
            add(link.window);
            digester.add(link.values.size());
            for (const ValueRef v : link.values) digester.add(resolver_.digest_of_value(v));
            if (link.datum.op >= 0) digester.add(resolver_.digest_of_value(link.datum));
        }
        op.digest = digester.digest();
        op.title = title();
        op.place = node_.place;
        op.node = index_;
        op.frame = frame_;
        const int added = static_cast<int>(resolver_.result_.ops.size());
        std::vector<ValueRef> values;
        for (int i = 0; i < static_cast<int>(op.outputs.size()); ++i) values.push_back({added, i});
        resolver_.result_.ops.push_back(std::move(op));
        return values;
    }

    std::shared_ptr<const void> remembered(
        const Digest& key, std::type_index type, std::size_t bytes,
        const std::function<std::shared_ptr<const void>()>& make) override {
        asked_.add(key);
        return resolver_.session_->remember(key, type, bytes, make);
    }

    Resolver& resolver_;
    const int index_;
    const GraphNode& node_;
    const int frame_;
    const Node& parsed_;
    const std::size_t first_op_, first_sink_;
    // All that the node looked at so far; an operation that it adds may depend on any of it.
    mutable Digester asked_{"asked"};
    mutable bool asked_frame_ = false;
    std::vector<const void*> operations_;
    std::vector<Error> warnings_;
    std::optional<Place> last_place_;
};

std::optional<Stream> Resolver::resolve_node(int node, int frame) {
    const Node* parsed = nullptr;
    try {
        parsed = node_at(node, frame);
    } catch (const AlreadyReported&) {
    }
    const auto enabled = graph_.is_enabled(node, frame, faults_of_graph());
    if (!parsed || !enabled) return std::nullopt;
    NodeBuilder builder(*this, node, frame, *parsed);
    try {
        if (!*enabled) return is_sink(node) ? Stream{} : builder.input(*graph_.leading_input(node, frame));
        Stream stream = parsed->resolve(builder);
        // What its type says was told to those who link to it.
        if (stream.data != graph_.nodes()[index(node)].type->gives)
            fail(ErrorKind::kInternal, "it gives another kind of value than it says");
        builder.finish();
        return stream;
    } catch (const NotYet&) {
        builder.take_back();
        throw;
    } catch (const Failure& f) {
        Error e = f.error();
        if (const auto* bad = dynamic_cast<const BadValue*>(&f))
            e.place = builder.place_of(bad->value());
        else if (e.place.file.empty())
            e.place = e.kind == ErrorKind::kInput ? builder.file_place() : builder.place();
        if (options_.inputs_may_come && dynamic_cast<const AbsentInput*>(&f))
            e.passing = Passing::kUnfinished;
        if (options_.known_sound && e.kind == ErrorKind::kGraph) e.kind = ErrorKind::kInput;
        if (e.node.empty()) e.node = builder.title();
        diagnostics_.error(std::move(e));
    } catch (const AlreadyReported&) {
    }
    builder.finish();
    return std::nullopt;
}

}  // namespace

std::string to_string(const Op& op) {
    Rect window;
    for (const ValueInfo& info : op.outputs) window = unite(window, info.window);
    return fmt::format("{}, frame {}: {} output{} of {}", op.title, op.frame, op.outputs.size(),
                       op.outputs.size() == 1 ? "" : "s", to_string(window));
}

std::optional<ResolvedFrame> resolve(const Graph& graph, int frame, const ResolveOptions& options,
                                     Diagnostics& diagnostics) {
    return Resolver(graph, frame, options, diagnostics).run();
}

}  // namespace keyline
