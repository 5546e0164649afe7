// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/graph/apply_options.h"

#include "engine/graph/graph_error.h"
#include "engine/json/json_reader.h"
#include "engine/node/registry.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>

namespace keyline {

namespace {

// Nothing where it is no value: that was told, and what else is wrong is told too.
std::optional<Value> option_value(const OptionValue& o, Diagnostics& diagnostics) {
    try {
        return parse_option_value(o.value, o.option);
    } catch (const Failure& f) {
        diagnostics.error(f.error());
        return std::nullopt;
    }
}

void set_member(Value& object, const std::string& key, Value value) {
    const Place place = value.place;
    const auto it = std::ranges::find(object.members, key, &Member::key);
    if (it == object.members.end())
        object.members.push_back({key, place, std::move(value)});
    else
        it->value = std::move(value);
}

void apply_set(const OptionValue& o, std::vector<GraphNode>& nodes, Diagnostics& diagnostics) {
    const auto dot = o.target.find('.');
    const std::string id = o.target.substr(0, dot);
    const Place place{o.option, 0, 0};
    if (dot == std::string::npos || dot + 1 == o.target.size())
        return graph_error(diagnostics, place, "it must be NODE.NAME=VALUE",
                           dot == std::string::npos ? "a variable is given with --var" : "");
    const auto node = std::ranges::find(nodes, id, &GraphNode::id);
    if (node == nodes.end())
        return graph_error(diagnostics, place, "there is no node " + in_quotes(id),
                           did_you_mean(id, ids_of(nodes)), {}, Code::kUnknownNode);
    const std::string name = o.target.substr(dot + 1);
    if (name == "type" || name == "about")
        return graph_error(diagnostics, place,
                           fmt::format("{} is neither a parameter nor an input", in_quotes(name)));
    if (auto value = option_value(o, diagnostics)) set_member(node->object, name, std::move(*value));
}

GraphNode output_node(const OptionValue& o, const NodeType* type, const std::shared_ptr<const Scope>& scope) {
    const Place place{o.option, 0, 0};
    GraphNode node{o.option, type, place, {}, std::nullopt, scope};
    node.object.kind = Value::Kind::kObject;
    node.object.place = place;
    const auto add = [&](const char* key, const std::string& text) {
        Value v;
        v.kind = Value::Kind::kString;
        v.text = text;
        v.place = place;
        node.object.members.push_back({key, place, std::move(v)});
    };
    add("in", o.target);
    add("file", o.value);
    return node;
}

}  // namespace

std::vector<std::pair<std::string, Value>> variable_overrides(const std::vector<OptionValue>& options,
                                                              Diagnostics& diagnostics) {
    std::vector<std::pair<std::string, Value>> out;
    for (const OptionValue& o : options)
        if (auto value = option_value(o, diagnostics)) out.emplace_back(o.target, std::move(*value));
    return out;
}

void apply_set_options(const std::vector<OptionValue>& options, std::vector<GraphNode>& nodes,
                       Diagnostics& diagnostics) {
    for (const OptionValue& o : options) apply_set(o, nodes, diagnostics);
}

void add_outputs(const LoadOptions& options, const std::shared_ptr<const Scope>& scope,
                 std::vector<GraphNode>& nodes) {
    const NodeType* type = registry().find(options.output_type);
    for (const OptionValue& o : options.outputs) nodes.push_back(output_node(o, type, scope));
}

std::vector<std::string> ids_of(const std::vector<GraphNode>& nodes) {
    std::vector<std::string> out;
    for (const GraphNode& n : nodes) out.push_back(n.id);
    return out;
}

}  // namespace keyline
