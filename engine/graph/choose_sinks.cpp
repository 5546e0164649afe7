// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/graph/choose_sinks.h"

#include "engine/graph/graph_error.h"
#include "engine/node/registry.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace keyline {

namespace {

bool is_sink(const GraphNode& n) { return n.type->kind == NodeKind::kSink; }

std::string sink_types() {
    std::vector<std::string> names;
    for (const auto& [name, type] : registry().types())
        if (type.kind == NodeKind::kSink) names.push_back(name);
    return listed(names);
}

void check_only(const std::vector<GraphNode>& nodes, const std::vector<std::string>& only,
                Diagnostics& diagnostics) {
    std::vector<std::string> sinks;
    for (const GraphNode& n : nodes)
        if (is_sink(n)) sinks.push_back(n.id);
    for (const std::string& id : only) {
        if (std::ranges::find(sinks, id) != sinks.end()) continue;
        std::string hint = did_you_mean(id, sinks);
        if (hint.empty() && !sinks.empty()) hint = "the graph writes with " + listed(sinks);
        graph_error(diagnostics, {"--only " + id, 0, 0},
                    fmt::format("{} is no output of the graph", in_quotes(id)), hint, {}, Code::kUnknownNode);
    }
}

}  // namespace

void check_enabled(const Graph& graph, int frame, Diagnostics& diagnostics) {
    for (int i = 0; const GraphNode& node : graph.nodes()) {
        const int index = i++;
        const bool is_always =
            !node.enabled || (node.enabled->is(Value::Kind::kBool) && node.enabled->boolean);
        if (is_always || is_sink(node)) continue;
        const auto leading = graph.leading_input(index, frame);
        const int from = leading ? graph.index_of(leading->node) : -1;
        if (leading && from < 0) continue;  // told where links are checked
        if (from < 0 || graph.nodes()[static_cast<std::size_t>(from)].type->gives != node.type->gives)
            graph_error(diagnostics, node.enabled->place,
                        "'enabled' can't leave it out: it has no input to pass on in its place",
                        "a variable in the next node's input chooses between two", node.title());
    }
}

bool has_sink(const std::vector<GraphNode>& nodes) { return std::ranges::any_of(nodes, is_sink); }

void report_no_sink(const Place& place, Diagnostics& diagnostics) {
    graph_error(diagnostics, place, "the graph writes nothing",
                "add a node of one of these types: " + sink_types(), {}, Code::kNoOutput);
}

std::vector<int> choose_sinks(const std::vector<GraphNode>& nodes, const LoadOptions& options,
                              Diagnostics& diagnostics) {
    const std::size_t first_output = nodes.size() - options.outputs.size();
    const auto is_chosen = [&](std::size_t i) {
        if (!options.outputs.empty()) return i >= first_output;
        return options.only.empty() || std::ranges::find(options.only, nodes[i].id) != options.only.end();
    };
    std::vector<int> sinks;
    for (std::size_t i = 0; i < nodes.size(); ++i)
        if (is_sink(nodes[i]) && is_chosen(i)) sinks.push_back(static_cast<int>(i));
    check_only(nodes, options.only, diagnostics);
    return sinks;
}

void warn_of_unused(const Graph& graph, Diagnostics& diagnostics) {
    const std::vector<int> in_use = graph.nodes_in_use();
    std::set<int> used(in_use.begin(), in_use.end());
    for (auto it = graph.order().rbegin(); it != graph.order().rend(); ++it) {
        const GraphNode& node = graph.nodes()[static_cast<std::size_t>(*it)];
        const bool is_in_reserve = graph.variables().is_a_choice(node.id) || !node.scope->is_enabled;
        if (is_in_reserve) used.insert(*it);
        if (used.contains(*it)) used.insert(graph.links(*it).begin(), graph.links(*it).end());
    }
    for (int i = 0; const GraphNode& node : graph.nodes())
        if (!used.contains(i++) && !node.scope->outer &&
            std::ranges::find(node.meant, Code::kUnused) == node.meant.end())
            diagnostics.warning({ErrorKind::kGraph,
                                 node.place,
                                 node.title(),
                                 "nothing that is written uses it; it is not run",
                                 {},
                                 Passing::kNever,
                                 Code::kUnused});
}

void warn_of_unused_variables(const Value& root, const Graph& graph, Diagnostics& diagnostics) {
    std::vector<const Value*> values;
    for (const char* key : {"ocio", "include"})
        if (const Value* value = root.find(key)) values.push_back(value);
    for (const std::span<const GraphNode> nodes : {graph.nodes(), graph.groups()})
        for (const GraphNode& node : nodes) {
            values.push_back(&node.object);
            if (node.enabled) values.push_back(&*node.enabled);
        }
    for (const Member& variable : graph.variables().unused_by(values))
        diagnostics.warning({ErrorKind::kGraph,
                             variable.key_place,
                             {},
                             fmt::format("nothing uses the variable {}", in_quotes(variable.key)),
                             {},
                             Passing::kNever,
                             Code::kUnused});
}

}  // namespace keyline
