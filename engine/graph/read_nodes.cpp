// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/graph/read_nodes.h"

#include "engine/base/identifier.h"
#include "engine/graph/any_node.h"
#include "engine/graph/apply_options.h"
#include "engine/graph/expand_groups.h"
#include "engine/graph/graph_error.h"
#include "engine/graph/group_search.h"
#include "engine/graph/variable_files.h"
#include "engine/json/json_reader.h"
#include "engine/node/registry.h"
#include "engine/params/frames.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace keyline {

namespace {

constexpr int kFormatVersion = 1;

// Whether the rest can be read; it is where the version is missing or none.
bool check_version(const Value& root, Diagnostics& diagnostics) {
    const Value* v = root.find("keyline");
    if (!v) {
        graph_error(diagnostics, root.place, "'keyline', the format's version, is missing",
                    "add \"keyline\": 1", {}, Code::kMissingKey);
    } else if (!v->is(Value::Kind::kNumber) || v->number != std::floor(v->number) || v->number < 1) {
        graph_error(diagnostics, v->place,
                    fmt::format("'keyline' is {}; it must be the format's version, 1", v->shown()), {}, {},
                    Code::kWrongValue);
    } else if (v->number > kFormatVersion) {
        graph_error(diagnostics, v->place,
                    fmt::format("the graph is of version {}; this program knows versions up to {}",
                                v->shown(), kFormatVersion),
                    "use a later Keyline");
        return false;
    }
    return true;
}

void check_top_level(const Value& root, Diagnostics& diagnostics) {
    static const std::vector<std::string> known{"keyline", "nodes", "about", "variables", "include",
                                                "frames",  "fps",   "ocio",  "$schema"};
    if (const Value* outputs = root.find("outputs"))
        return graph_error(diagnostics, outputs->place, "this is a group: what has outputs is a node's type",
                           "run a graph that uses it");
    for (const Member& m : root.members) {
        if (std::ranges::find(known, m.key) == known.end()) {
            const std::string hint = did_you_mean(m.key, known);
            graph_error(diagnostics, m.key_place, "unknown key " + in_quotes(m.key),
                        hint.empty() ? "known are " + listed(known) : hint, {}, Code::kUnknownKey);
        }
        if (m.key == "about" || m.key == "$schema") check_text(m, diagnostics);
    }
    if (!root.find("nodes"))
        graph_error(diagnostics, root.place, "'nodes' is missing", {}, {}, Code::kMissingKey);
}

std::string read_ocio(const Value& v, const Variables& variables, Diagnostics& diagnostics) {
    const Value substituted = variables.substitute(v, std::nullopt, diagnostics);
    if (substituted.is(Value::Kind::kString) && !substituted.text.empty()) return substituted.text;
    graph_error(diagnostics, v.place,
                fmt::format("'ocio' is {}; it must be the file name of an OpenColorIO config", v.shown()), {},
                {}, Code::kWrongValue);
    return {};
}

Shot read_shot(const Value& root, Diagnostics& diagnostics) {
    Shot shot;
    if (const Value* v = root.find("frames")) {
        try {
            if (!v->is(Value::Kind::kString)) fail(ErrorKind::kGraph, "it must be text, as \"1001-1100\"");
            const std::vector<int> frames = parse_frames(v->text);
            shot.first = std::ranges::min(frames);
            shot.last = std::ranges::max(frames);
        } catch (const Failure& f) {
            graph_error(diagnostics, v->place, fmt::format("'frames' is {}: {}", v->shown(), f.error().what),
                        {}, {}, Code::kWrongValue);
        }
    }
    if (const Value* v = root.find("fps")) {
        if (v->is(Value::Kind::kNumber) && v->number > 0)
            shot.fps = v->number;
        else
            graph_error(diagnostics, v->place,
                        fmt::format("'fps' is {}; it must be a number of frames a second", v->shown()), {},
                        {}, Code::kWrongValue);
    }
    return shot;
}

// Those of --set that are for nodes: groups have had theirs.
std::vector<OptionValue> options_for_nodes(std::vector<OptionValue> options,
                                           const std::vector<GraphNode>& groups) {
    std::erase_if(options, [&](const OptionValue& o) {
        return std::ranges::find(groups, o.target.substr(0, o.target.find('.')), &GraphNode::id) !=
               groups.end();
    });
    return options;
}

// Nodes as written, their types not looked up yet: --set may still change them.
class NodeReader {
public:
    NodeReader(ReadGraph& read, Diagnostics& diagnostics) : read_(read), diagnostics_(diagnostics) {}

    void read_all(const Value& nodes) {
        if (!nodes.is(Value::Kind::kObject))
            return graph_error(diagnostics_, nodes.place,
                               fmt::format("'nodes' is {}; it must be an object of id: node", nodes.shown()),
                               {}, {}, Code::kWrongValue);
        for (const Member& m : nodes.members) read_one(m);
    }

    // Of the program's own making, under ids that no file can have.
    void add(const Value& nodes) {
        for (const Member& m : nodes.members)
            read_.nodes.push_back({m.key, nullptr, m.key_place, m.value, std::nullopt, read_.scope});
    }

    // Takes `type` and `about` out of each object and looks the type up.
    void resolve_types() {
        for (GraphNode& node : read_.nodes)
            if (!node.type) resolve_type(node);
        std::erase_if(read_.nodes, [&](const GraphNode& n) {
            if (!n.type) read_.unknown_ids.insert(n.id);
            return !n.type;
        });
    }

private:
    void read_one(const Member& m) {
        if (!is_identifier(m.key))
            graph_error(diagnostics_, m.key_place, fmt::format("{} is no node id", in_quotes(m.key)),
                        fmt::format("an id is {}", kIdentifierForm), {}, Code::kWrongValue);
        if (!m.value.is(Value::Kind::kObject)) {
            read_.unknown_ids.insert(m.key);
            return graph_error(
                diagnostics_, m.value.place,
                fmt::format("node {} is {}; it must be an object", in_quotes(m.key), m.value.shown()), {}, {},
                Code::kWrongValue);
        }
        read_.nodes.push_back({m.key, nullptr, m.key_place, m.value, std::nullopt, read_.scope});
        read_.nodes.back().object.place = m.key_place;  // where what is missing is told
    }

    void resolve_type(GraphNode& node) {
        const auto error = [&](Code code, const Place& place, std::string what, std::string hint = {}) {
            graph_error(diagnostics_, place, std::move(what), std::move(hint), "node '" + node.id + "'",
                        code);
        };
        const Value* type = node.object.find("type");
        if (!type)
            error(Code::kMissingKey, node.place, "'type' is missing");
        else if (!type->is(Value::Kind::kString))
            error(Code::kWrongValue, type->place,
                  fmt::format("'type' is {}; it must be a string", type->shown()));
        else if (!(node.type = registry().find(type->text)))
            error(Code::kUnknownType, type->place, "there is no node type " + in_quotes(type->text),
                  near_type(type->text, node.scope->file.parent_path()));
        else if (node.scope->outer && node.type->kind == NodeKind::kSink)
            error(Code::kLinkKind, type->place, "a group writes nothing",
                  "write what it gives where it is used");
        take_what_any_node_has(node, "node '" + node.id + "'", diagnostics_);
    }

    ReadGraph& read_;
    Diagnostics& diagnostics_;
};

}  // namespace

std::optional<ReadGraph> read_nodes(const Value& root, const LoadOptions& options,
                                    const std::filesystem::path& folder, Diagnostics& diagnostics) {
    if (!root.is(Value::Kind::kObject)) {
        graph_error(diagnostics, root.place, "a graph is an object with 'keyline' and 'nodes'");
        return std::nullopt;
    }
    if (!check_version(root, diagnostics)) return std::nullopt;
    check_top_level(root, diagnostics);
    ReadGraph read;
    VariableSources sources = variable_sources(root, options, folder, diagnostics);
    sources.shot = read_shot(root, diagnostics);
    const auto scope = std::make_shared<Scope>();
    scope->variables = std::make_shared<const Variables>(sources, diagnostics);
    scope->file = root.place.file;
    scope->folder = folder;
    read.scope = scope;
    if (const Value* v = root.find("ocio")) read.ocio = read_ocio(*v, *scope->variables, diagnostics);
    NodeReader reader(read, diagnostics);
    if (const Value* nodes = root.find("nodes")) reader.read_all(*nodes);
    expand_groups(options, scope, read, diagnostics);
    apply_set_options(options_for_nodes(options.set, read.groups), read.nodes, diagnostics);
    if (!options.added.empty()) reader.add(parse_json(options.added, "added nodes"));
    add_outputs(options, scope, read.nodes);
    reader.resolve_types();
    return read;
}

}  // namespace keyline
