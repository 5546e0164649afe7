// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/base/index.h"
#include "engine/node/ids.h"
#include "engine/node/mixing.h"
#include "engine/node/node_type.h"

// From a plain struct to what the engine runs.  Everything about a node that can be known from its
// declaration is derived here, once.

namespace KEYLINE_API keyline {

// Reports what is wrong between parameters: `static void check(const Params& p, Check& c)`.
class Check {
public:
    Check(const Value& object, ParamReader& reader) : object_(object), reader_(reader) {}
    void error(const char* name, std::string what, std::string hint = {}) {
        reader_.error(value(name).place, std::move(what), std::move(hint), Code::kAgainstEachOther);
    }
    // The same of one item of a list, counted from 0.
    void error(const char* list, std::size_t item, std::string what, std::string hint = {}) {
        const Value& v = value(list);
        reader_.error(item < v.items.size() ? v.items[item].place : v.place, std::move(what), std::move(hint),
                      Code::kAgainstEachOther);
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
concept GatherNode = requires {
    typename T::State;
    typename T::Partial;
};
template <class T>
concept DeriveNode = requires(const T& t, const Inputs& in) {
    { t.derive(in) } -> DataKind;
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
    else if constexpr (GatherNode<T>)
        return NodeKind::kGather;
    else if constexpr (DeriveNode<T>)
        return NodeKind::kDerive;
    else if constexpr (HasHalo<T> || MovingNode<T>)
        return NodeKind::kStencil;
    else
        return NodeKind::kPoint;
}

template <class T>
class OperationOf final : public Operation {
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
            node_->compute(in.slot(0).front(), out.front(), scratch);
        else
            node_->compute(in, out, scratch);
    }
    double cost() const override {
        if constexpr (requires { node_->cost(); })
            return node_->cost();
        else
            return Operation::cost();
    }

private:
    std::shared_ptr<const T> node_;
};

template <class T>
std::shared_ptr<const Operation> make_operation(std::shared_ptr<const T> node) {
    return std::make_shared<const OperationOf<T>>(std::move(node));
}

// State and partial of a node, as the engine passes them around.
template <class Base, class T>
struct Held final : Base {
    explicit Held(T v) : value(std::move(v)) {}
    T value;
};

template <class T>
class GatherOf final : public Gather {
    using NodeState = typename T::State;
    using NodePartial = typename T::Partial;
    using HeldState = Held<State, NodeState>;
    using HeldPartial = Held<Partial, NodePartial>;

public:
    using Made = std::remove_cvref_t<decltype(std::declval<const T&>().finish(std::declval<NodeState>()))>;

    explicit GatherOf(std::shared_ptr<const T> node) : node_(std::move(node)) {}

    const char* gives() const override { return Made::kind; }
    int rounds() const override {
        if constexpr (requires { node_->rounds(); })
            return node_->rounds();
        else
            return 1;
    }
    std::unique_ptr<State> start(const Rect& window) const override {
        return std::make_unique<HeldState>(node_->start(window));
    }
    std::unique_ptr<Partial> map(const State& state, const Inputs& in, const Rect& block,
                                 Scratch& scratch) const override {
        return std::make_unique<HeldPartial>(
            node_->map(static_cast<const HeldState&>(state).value, in, block, scratch));
    }
    void fold(State& state, Partial& partial) const override {
        node_->fold(of(state), std::move(static_cast<HeldPartial&>(partial).value));
    }
    void end_round(State& state) const override {
        if constexpr (requires { node_->rounds(); }) node_->end_round(of(state));
    }
    std::shared_ptr<const Datum> finish(State& state) const override {
        return make_datum(node_->finish(std::move(of(state))));
    }
    std::size_t state_bytes(const Rect& window) const override { return node_->state_bytes(window); }
    std::size_t partial_bytes(const Rect& block) const override { return node_->partial_bytes(block); }
    std::size_t datum_bytes(const Rect& window) const override { return node_->datum_bytes(window); }

private:
    static NodeState& of(State& state) { return static_cast<HeldState&>(state).value; }

    std::shared_ptr<const T> node_;
};

template <class T>
class DerivationOf final : public Derivation {
public:
    using Made = std::remove_cvref_t<decltype(std::declval<const T&>().derive(std::declval<Inputs>()))>;

    explicit DerivationOf(std::shared_ptr<const T> node) : node_(std::move(node)) {}

    const char* gives() const override { return Made::kind; }
    std::shared_ptr<const Datum> derive(const Inputs& in) const override {
        return make_datum(node_->derive(in));
    }
    std::size_t datum_bytes() const override { return node_->datum_bytes(); }

private:
    std::shared_ptr<const T> node_;
};

// Says which kind of data a node gives, if it gives no pixels.  A source and a compound say it themselves.
template <class T>
void tell_what_it_gives(NodeType& type) {
    const auto tell = [&]<DataKind Made>() {
        type.gives = Made::kind;
        type.parts = parts_of<Made>();
    };
    if constexpr (requires { typename T::Gives; })
        tell.template operator()<typename T::Gives>();
    else if constexpr (GatherNode<T>)
        tell.template operator()<typename GatherOf<T>::Made>();
    else if constexpr (DeriveNode<T>)
        tell.template operator()<typename DerivationOf<T>::Made>();
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
std::vector<Link> make_links(Builder& builder, const std::vector<Port>& ports);
Stream make_stream(const Port& lead, const Rect& window, const Makes& makes,
                   const std::vector<ValueRef>& values, const Nature& nature);

// What is known of colour that is made of what flows in: that in which all of it agrees of which something is
// known.
Nature nature_of(const std::vector<Port>& ports);
Stream make_data_stream(const std::vector<Port>& ports, const char* kind, ValueRef datum);

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

// The data window of the result: what the node says, else what its kind of operation makes of its inputs'.
template <class T>
Rect window_of(const T& node, const Operation& operation, const std::vector<Port>& ports,
               std::span<const Link> links, std::size_t outputs) {
    if constexpr (requires { node.window(ports); })
        return node.window(ports);
    else if constexpr (MovingNode<T>)
        return leading_port(ports).stream.window;
    else
        return result_window(operation, links, outputs);
}

// A node that makes a matte of every channel compares its samples; others would make new ids of old ones.
template <class T>
constexpr bool kMakesMattes = requires {
    T::makes_mattes;
};

template <class T>
Stream add_per_channel(Builder& builder, const std::shared_ptr<const T>& node, const Port& port) {
    Stream result = port.stream;
    if (result.channels.empty()) return result;
    const auto operation = make_operation(node);
    if (!kMakesMattes<T>) tell_of_ids(builder, result);
    const auto link = [&](ValueRef value) { return std::vector{Link(port.stream, {value})}; };
    result.window = window_of(*node, *operation, {port}, link(result.channels.front().value), 1);
    for (StreamChannel& channel : result.channels) {
        if (channel.exact() && !kMakesMattes<T>) continue;
        const ValueRef from = as_number(builder, channel, port.stream.window);
        channel.value = builder.add(operation, link(from), result.window, 1).front();
        if (kMakesMattes<T>) channel = {channel.name, channel.value};
    }
    return result;
}

template <class T>
Stream add_together(Builder& builder, const std::shared_ptr<const T>& node, const std::vector<Port>& ports) {
    const Makes makes = makes_of(*node, ports);
    const auto operation = make_operation(node);
    std::vector<Link> links = make_links(builder, ports);
    const Rect window = window_of(*node, *operation, ports, links, makes.channels.size());
    const auto values =
        builder.add(operation, std::move(links), window, static_cast<int>(makes.channels.size()));
    Nature nature = nature_of(ports);
    if constexpr (requires { node->describe(builder, nature); }) node->describe(builder, nature);
    Stream result = make_stream(leading_port(ports), window, makes, values, nature);
    if constexpr (requires(Metadata & m) { node->edit(m); }) {
        auto metadata = std::make_shared<Metadata>(*result.metadata);
        node->edit(*metadata);
        result.metadata = std::move(metadata);
    }
    return result;
}

template <class T>
Stream add_data(Builder& builder, const std::shared_ptr<const T>& node, const std::vector<Port>& ports) {
    if constexpr (GatherNode<T>) {
        const std::vector<Link> links = make_links(builder, ports);
        Rect frame;  // a gather sees its inputs as far as they go
        for (const Link& link : links) frame = unite(frame, link.extent);
        const ValueRef datum = builder.add(std::make_shared<const GatherOf<T>>(node), links, frame);
        return make_data_stream(ports, GatherOf<T>::Made::kind, datum);
    } else {
        const ValueRef datum =
            builder.add(std::make_shared<const DerivationOf<T>>(node), make_links(builder, ports));
        return make_data_stream(ports, DerivationOf<T>::Made::kind, datum);
    }
}

template <class Params>
std::vector<Port> connect(Builder& builder, const Params& params, int slots) {
    std::vector<Port> ports(static_cast<std::size_t>(slots));
    for_each<Input>(params, [&](const Input& in, const char*, const Constraint& c) {
        ports[index(in.slot)] = {c.takes, c.leading, true, builder.input(in), in.place};
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

// Adds a point operation, stencil, gather or derivation to the frame.
template <class T>
Stream add_operation(Builder& builder, std::shared_ptr<const T> node, const std::vector<Port>& ports) {
    if constexpr (requires { node->identity(); })
        if (node->identity() && builder.leaves_out_identities()) return detail::leading_port(ports).stream;
    if constexpr (GatherNode<T> || DeriveNode<T>)
        return detail::add_data(builder, node, ports);
    else if constexpr (PerChannelNode<T>)
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
    Value to_value() const override { return fields_to_value(params_); }

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
                ports[index(in.slot)].needed = node.needs(in);
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
std::unique_ptr<const Node> make_node(const std::vector<FieldInfo>& fields, const Value& object,
                                      ParamReader& reader) {
    typename T::Params params;
    read_fields(object, fields, reader.base(), params);
    if constexpr (requires(Check & c) { T::check(params, c); }) {
        Check check(object, reader);
        T::check(params, check);
        if (reader.failed()) return nullptr;
    }
    int slots = 0;
    for_each<Input>(params, [&](Input& in, const char*, const Constraint&) { in.slot = slots++; });
    return std::make_unique<NodeOf<T>>(std::move(params), slots);
}

namespace detail {

template <class T>
concept ComputeNode = requires(const T& t, const Inputs& in, Outputs out, Scratch& s) {
    t.compute(in, out, s);
};

// Whether there is an input that is always connected.
template <class... Fields>
constexpr bool has_required_input(const std::tuple<Fields...>&) {
    return (std::same_as<typename Fields::Type, Input> || ...);
}

// What a node can get wrong without the compiler noticing, told in words.
template <class T>
constexpr void check_shape() {
    if constexpr (requires { &T::read; })
        static_assert(SourceNode<T>, "read must be: Stream read(Builder&) const");
    if constexpr (requires { &T::write; })
        static_assert(SinkNode<T>, "write must be: void write(Builder&) const");
    if constexpr (requires { &T::expand; })
        static_assert(CompoundNode<T>, "expand must be: Stream expand(Builder&) const");
    if constexpr (requires { &T::derive; })
        static_assert(DeriveNode<T>, "derive must be: SomeDatum derive(const Inputs&) const");
    if constexpr (requires { &T::halo; }) static_assert(HasHalo<T>, "halo must be: Halo halo() const");
    if constexpr (requires { &T::demand; })
        static_assert(MovingNode<T>, "demand must be: Rect demand(const Rect& out, int slot) const");
    constexpr NodeKind kind = kind_of<T>();
    if constexpr (kind == NodeKind::kPoint || kind == NodeKind::kStencil) {
        static_assert(PerChannelNode<T> || ComputeNode<T>,
                      "a node has read, write, expand, derive, State and Partial, or one of: "
                      "void compute(const View&, const MutView&, Scratch&) const, "
                      "void compute(const Inputs&, Outputs, Scratch&) const");
        static_assert(
            PerChannelNode<T> || requires { T::outputs; } ||
                requires(const T& t, const std::vector<Port>& ports) {
                    { t.makes(ports) } -> std::same_as<Makes>;
                },
            "a node that computes its channels together names them: "
            "static constexpr std::array outputs{...}, or Makes makes(const std::vector<Port>&) "
            "const");
        static_assert(has_required_input(T::Params::fields),
                      "a node that computes pixels takes its frame from an input that must be given; "
                      "without one, make it a compound");
    }
}

}  // namespace detail

template <class T>
NodeType make_node_type() {
    detail::check_shape<T>();
    NodeType type;
    type.name = T::info.name;
    type.help = T::info.help;
    type.version = T::info.version;
    type.kind = kind_of<T>();
    type.fields = describe_fields<typename T::Params>();
    if constexpr (requires { T::outputs; })
        for (const char* name : T::outputs) type.outputs.emplace_back(name);
    tell_what_it_gives<T>(type);
    type.make = &make_node<T>;
    return type;
}

}  // namespace keyline

// Makes a node known under a name: KEYLINE_NODE(gaussian, Gaussian), at the end of
// nodes/filters/gaussian.cpp.
#define KEYLINE_NODE(id, Type) \
    keyline::NodeType keyline_node_type_##id() { return keyline::make_node_type<Type>(); }
