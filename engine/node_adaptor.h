// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/mixing.h"
#include "engine/node_type.h"

// From a plain struct to what the engine runs.  Everything about a node that can be known from its
// declaration is derived here, once.

namespace keyline {

// Reports what is wrong between parameters: `static void check(const Params& p, Check& c)`.
class Check {
public:
    Check(const Value& object, ParamReader& reader) : object_(object), reader_(reader) {}
    void error(const char* name, std::string what, std::string hint = {}) {
        reader_.error(value(name).place, std::move(what), std::move(hint));
    }
    // The same of one item of a list, counted from 0.
    void error(const char* list, std::size_t item, std::string what, std::string hint = {}) {
        const Value& v = value(list);
        reader_.error(item < v.items.size() ? v.items[item].place : v.place, std::move(what),
                      std::move(hint));
    }

private:
    const Value& value(const char* name) const {
        const Value* v = object_.find(name);
        return v ? *v : object_;
    }

    const Value& object_;
    ParamReader& reader_;
};

template <class T>
concept SourceNode = requires(const T& t, Builder& b) {
    { t.read(b) } -> std::same_as<Stream>;
};
template <class T>
concept SinkNode = requires(const T& t, Builder& b) {
    { t.write(b) } -> std::same_as<void>;
};
template <class T>
concept CompoundNode = requires(const T& t, Builder& b) {
    { t.expand(b) } -> std::same_as<Stream>;
};
template <class T>
concept WholeFrameNode = requires {
    typename T::State;
    typename T::Partial;
};
template <class T>
concept PerChannelNode = requires(const T& t, const View& in, const MutView& out, Scratch& s) {
    t.compute(in, out, s);
};
template <class T>
concept MovingNode = requires(const T& t, const Rect& out, int slot) {
    { t.demand(out, slot) } -> std::same_as<Rect>;
};
template <class T>
concept MixedNode = std::derived_from<typename T::Params, Mixed>;
template <class T>
concept HasHalo = requires(const T& t) {
    { t.halo() } -> std::convertible_to<Halo>;
};

template <class T>
constexpr NodeKind kind_of() {
    if constexpr (SourceNode<T>)
        return NodeKind::kSource;
    else if constexpr (SinkNode<T>)
        return NodeKind::kSink;
    else if constexpr (CompoundNode<T>)
        return NodeKind::kCompound;
    else if constexpr (WholeFrameNode<T>)
        return NodeKind::kWholeFrame;
    else if constexpr (HasHalo<T> || MovingNode<T>)
        return NodeKind::kStencil;
    else
        return NodeKind::kPoint;
}

template <class T>
class OperationOf : public Operation {
public:
    explicit OperationOf(std::shared_ptr<const T> node) : node_(std::move(node)) {}

    Halo halo() const override {
        if constexpr (HasHalo<T>)
            return node_->halo();
        else
            return {};
    }
    bool point() const override { return !MovingNode<T> && Operation::point(); }
    Rect demand(const Rect& out, int slot) const override {
        if constexpr (MovingNode<T>)
            return node_->demand(out, slot);
        else
            return Operation::demand(out, slot);
    }
    void compute(const Inputs& in, Outputs out, Scratch& scratch) const override {
        if constexpr (PerChannelNode<T>)
            node_->compute(in[Input{{}, {}, {}, 0}].front(), out.front(), scratch);
        else if constexpr (!WholeFrameNode<T>)
            node_->compute(in, out, scratch);
    }
    double cost() const override {
        if constexpr (requires { node_->cost(); })
            return node_->cost();
        else
            return Operation::cost();
    }

protected:
    const T& node() const { return *node_; }

private:
    std::shared_ptr<const T> node_;
};

template <class T>
struct MemoryOf final : Memory {
    explicit MemoryOf(T v) : value(std::move(v)) {}
    T value;
};

template <class T>
class ReductionOf final : public OperationOf<T>, public Reduction {
public:
    using OperationOf<T>::OperationOf;
    using State = typename T::State;
    using Partial = typename T::Partial;

    const Reduction* reduction() const override { return this; }
    int rounds() const override { return this->node().rounds(); }
    std::unique_ptr<Memory> start(const Rect& window) const override {
        return std::make_unique<MemoryOf<State>>(this->node().start(window));
    }
    std::unique_ptr<Memory> map(const Memory& state, const Inputs& in, const Rect& block,
                                Scratch& scratch) const override {
        return std::make_unique<MemoryOf<Partial>>(this->node().map(get<State>(state), in, block, scratch));
    }
    void fold(Memory& state, Memory& partial) const override {
        this->node().fold(get<State>(state), std::move(get<Partial>(partial)));
    }
    void finish(Memory& state) const override { this->node().finish(get<State>(state)); }
    void apply(const Memory& state, Outputs out, Scratch& scratch) const override {
        this->node().compute(get<State>(state), out, scratch);
    }
    std::size_t state_bytes(const Rect& window) const override { return this->node().state_bytes(window); }

private:
    template <class V>
    static V& get(Memory& m) {
        return static_cast<MemoryOf<V>&>(m).value;
    }
    template <class V>
    static const V& get(const Memory& m) {
        return static_cast<const MemoryOf<V>&>(m).value;
    }
};

template <class T>
std::shared_ptr<const Operation> make_operation(std::shared_ptr<const T> node) {
    if constexpr (WholeFrameNode<T>)
        return std::make_shared<ReductionOf<T>>(std::move(node));
    else
        return std::make_shared<OperationOf<T>>(std::move(node));
}

// One input of a node as it stands in the frame being resolved.
struct Port {
    Takes takes;
    bool leading = false, connected = false;
    Stream stream;
    Place place = {};    // of the input in the graph
    bool needed = true;  // no: it is checked, and never read
};

// Channels that a node makes, and where the others of the result come from.
struct Makes {
    std::vector<std::string> channels;
    bool passes_others = false;  // the leading input's other channels pass through
};

namespace detail {

const Port& leading_port(const std::vector<Port>& ports);
std::vector<Link> make_links(const std::vector<Port>& ports);
Stream make_stream(const Port& lead, const Rect& window, const Makes& makes,
                   const std::vector<ValueRef>& values);

template <class T>
Makes makes_of(const T& node, const std::vector<Port>& ports) {
    if constexpr (requires { node.makes(ports); }) {
        return node.makes(ports);
    } else {
        Makes makes;
        for (const char* name : T::outputs) makes.channels.emplace_back(name);
        if constexpr (requires { T::passes_others; }) makes.passes_others = T::passes_others;
        return makes;
    }
}

template <class T>
Rect window_of(const T& node, const std::vector<Port>& ports) {
    if constexpr (requires { node.window(ports); })
        return node.window(ports);
    else
        return leading_port(ports).stream.window;
}

template <class T>
Stream add_per_channel(Builder& builder, const std::shared_ptr<const T>& node, const Port& port) {
    Stream result = port.stream;
    const auto operation = make_operation(node);
    for (StreamChannel& channel : result.channels)
        channel.value =
            builder.add(operation, {{port.stream.window, {channel.value}}}, result.window, 1).front();
    return result;
}

template <class T>
Stream add_together(Builder& builder, const std::shared_ptr<const T>& node, const std::vector<Port>& ports) {
    const Makes makes = makes_of(*node, ports);
    const Rect window = window_of(*node, ports);
    const auto values =
        builder.add(make_operation(node), make_links(ports), window, static_cast<int>(makes.channels.size()));
    Stream result = make_stream(leading_port(ports), window, makes, values);
    if constexpr (requires(Metadata & m) { node->edit(m); }) {
        auto metadata = std::make_shared<Metadata>(*result.metadata);
        node->edit(*metadata);
        result.metadata = std::move(metadata);
    }
    return result;
}

template <class Params>
std::vector<Port> connect(Builder& builder, const Params& params, int slots) {
    std::vector<Port> ports(static_cast<std::size_t>(slots));
    for_each<Input>(params, [&](const Input& in, const char*, const Constraint& c) {
        ports[static_cast<std::size_t>(in.slot)] = {c.takes, c.leading, true, builder.input(in), in.place};
    });
    if constexpr (std::derived_from<Params, Mixed>)
        if (params.mask) ports.pop_back();  // the last declared; mix_back() uses it
    return ports;
}

// The leading input: what a MixedNode mixes its result with.
template <class Params>
Input leading_input(const Params& params) {
    std::optional<Input> first, leading;
    for_each<Input>(params, [&](const Input& in, const char*, const Constraint& c) {
        if (!first) first = in;
        if (c.leading) leading = in;
    });
    return leading ? *leading : *first;
}

}  // namespace detail

// Adds a point operation, stencil or whole-frame node to the frame.
template <class T>
Stream add_operation(Builder& builder, std::shared_ptr<const T> node, const std::vector<Port>& ports) {
    if constexpr (requires { node->identity(); })
        if (node->identity() && builder.leaves_out_identities()) return detail::leading_port(ports).stream;
    if constexpr (PerChannelNode<T>)
        return detail::add_per_channel(builder, node, ports.front());
    else
        return detail::add_together(builder, node, ports);
}

// The same for a compound: an operation that is not in the graph, on streams at hand, in slot order.
template <class T>
Stream add_operation(Builder& builder, T node, const std::vector<Stream>& streams) {
    std::vector<Port> ports;
    typename T::Params declared;
    for_each<Input>(declared, [&](const Input&, const char*, const Constraint& c) {
        ports.push_back({c.takes, c.leading, true, streams[ports.size()]});
    });
    return add_operation(builder, std::make_shared<const T>(std::move(node)), ports);
}

template <class T>
class NodeOf final : public Node {
public:
    using Params = typename T::Params;
    NodeOf(Params params, int slots) : params_(std::move(params)), slots_(slots) {}

    std::vector<Input> inputs() const override {
        std::vector<Input> out;
        for_each<Input>(params_, [&](const Input& in, const char*, const Constraint&) { out.push_back(in); });
        return out;
    }
    std::vector<FileName> files() const override {
        std::vector<FileName> out;
        for_each<FileName>(params_,
                           [&](const FileName& f, const char*, const Constraint&) { out.push_back(f); });
        return out;
    }
    Value to_value() const override { return fields_to_value(Params::fields, params_); }

    Stream resolve(Builder& builder) const override {
        if constexpr (MixedNode<T>)
            return mix_back(builder, builder.input(detail::leading_input(params_)), make(builder), params_);
        else
            return make(builder);
    }

private:
    Stream make(Builder& builder) const {
        const auto node = prepare(builder);
        if constexpr (SourceNode<T>)
            return node->read(builder);
        else if constexpr (SinkNode<T>)
            return node->write(builder), Stream{};
        else if constexpr (CompoundNode<T>)
            return node->expand(builder);
        else
            return add_operation(builder, node, needed(*node, detail::connect(builder, params_, slots_)));
    }

    // What makes no difference with these parameters need not be computed.
    std::vector<Port> needed(const T& node, std::vector<Port> ports) const {
        if constexpr (requires(const Input& in) { node.needs(in); })
            for_each<Input>(params_, [&](const Input& in, const char*, const Constraint&) {
                ports[static_cast<std::size_t>(in.slot)].needed = node.needs(in);
            });
        return ports;
    }

    std::shared_ptr<const T> prepare(Context& context) const {
        if constexpr (std::constructible_from<T, const Params&, Context&>)
            return std::make_shared<const T>(params_, context);
        else
            return std::make_shared<const T>(params_);
    }

    Params params_;
    int slots_;
};

template <class T>
std::unique_ptr<const Node> parse_node(const Value& object, ParamReader& reader) {
    typename T::Params params;
    parse_fields(object, T::Params::fields, params, reader);
    if (reader.failed()) return nullptr;
    if constexpr (requires(Check & c) { T::check(params, c); }) {
        Check check(object, reader);
        T::check(params, check);
        if (reader.failed()) return nullptr;
    }
    int slots = 0;
    for_each<Input>(params, [&](Input& in, const char*, const Constraint&) { in.slot = slots++; });
    return std::make_unique<NodeOf<T>>(std::move(params), slots);
}

template <class T>
NodeType make_node_type() {
    NodeType type;
    type.name = T::info.name;
    type.help = T::info.help;
    type.kind = kind_of<T>();
    type.fields = describe_fields(T::Params::fields, typename T::Params{});
    if constexpr (requires { T::outputs; })
        for (const char* name : T::outputs) type.outputs.emplace_back(name);
    type.parse = &parse_node<T>;
    return type;
}

}  // namespace keyline

// Makes a node known under a name: KEYLINE_NODE(gaussian, Gaussian), at the end of nodes/gaussian.cpp.
#define KEYLINE_NODE(id, Type) \
    keyline::NodeType keyline_node_type_##id() { return keyline::make_node_type<Type>(); }
