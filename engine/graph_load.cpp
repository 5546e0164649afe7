// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/graph.h"
#include "engine/graph_json.h"
#include "engine/registry.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <set>

namespace keyline {

namespace {

constexpr int kFormatVersion = 1;

bool is_identifier(std::string_view id) {
    const auto is_start = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) || c == '_'; };
    const auto is_part = [&](char c) {
        return is_start(c) || std::isdigit(static_cast<unsigned char>(c)) || c == '-';
    };
    return !id.empty() && is_start(id[0]) && std::ranges::all_of(id, is_part);
}

}  // namespace

// Goes through a graph file once, telling everything that is wrong with it.
class GraphLoader {
public:
    GraphLoader(Graph& graph, const LoadOptions& options, Diagnostics& diagnostics)
        : graph_(graph), options_(options), diagnostics_(diagnostics) {}

    void load(const Value& root) {
        if (!root.is(Value::Kind::kObject))
            return error(root.place, "a graph is an object with 'keyline' and 'nodes'");
        root_place_ = root.place;
        if (!check_version(root)) return;
        check_top_level(root);
        load_variables(root);
        load_nodes(root);
        apply_set_options();
        add_outputs();
        resolve_types();
        if (!diagnostics_.ok() && graph_.nodes_.empty()) return;
        check_nodes();
        choose_sinks();
    }

private:
    void error(const Place& place, std::string what, std::string hint = {}, std::string node = {}) {
        diagnostics_.error({ErrorKind::kGraph, place, std::move(node), std::move(what), std::move(hint)});
    }

    bool check_version(const Value& root) {
        const Value* v = root.find("keyline");
        if (!v)
            return error(root.place, "'keyline', the format's version, is missing", "add \"keyline\": 1"),
                   true;
        if (!v->is(Value::Kind::kNumber) || v->number != std::floor(v->number) || v->number < 1)
            return error(v->place,
                         fmt::format("'keyline' is {}; it must be the format's version, 1", v->shown())),
                   true;
        if (v->number <= kFormatVersion) return true;
        error(v->place,
              fmt::format("the graph is of version {}; this program knows versions up to {}", v->shown(),
                          kFormatVersion),
              "use a later Keyline");
        return false;
    }

    void check_top_level(const Value& root) {
        static const std::vector<std::string> known{"keyline",   "nodes", "about",
                                                    "variables", "ocio",  "$schema"};
        for (const Member& m : root.members) {
            if (std::ranges::find(known, m.key) == known.end()) {
                std::string hint = did_you_mean(m.key, known);
                error(m.key_place, "unknown key " + in_quotes(m.key),
                      hint.empty() ? "known are " + listed(known) : hint);
            }
            if ((m.key == "about" || m.key == "$schema") && !m.value.is(Value::Kind::kString))
                error(m.value.place, fmt::format("'{}' is {}; it must be a string", m.key, m.value.shown()));
        }
        if (!root.find("nodes")) error(root.place, "'nodes' is missing");
    }

    void load_variables(const Value& root) {
        std::vector<std::pair<std::string, Value>> overrides;
        for (const OptionValue& o : options_.var)
            overrides.emplace_back(o.target, parse_option_value(o.value, o.option));
        graph_.variables_.emplace(root.find("variables"), overrides, diagnostics_);
        if (const Value* v = root.find("ocio")) load_ocio(*v);
    }

    void load_ocio(const Value& v) {
        const Value substituted = graph_.variables_->substitute(v, std::nullopt, diagnostics_);
        if (substituted.is(Value::Kind::kString) && !substituted.text.empty())
            graph_.ocio_ = graph_.folder_ / substituted.text;
        else
            error(v.place,
                  fmt::format("'ocio' is {}; it must be the file name of an OpenColorIO config", v.shown()));
    }

    void load_nodes(const Value& root) {
        const Value* nodes = root.find("nodes");
        if (!nodes) return;
        if (!nodes->is(Value::Kind::kObject))
            return error(nodes->place,
                         fmt::format("'nodes' is {}; it must be an object of id: node", nodes->shown()));
        for (const Member& m : nodes->members) load_node(m);
    }

    void load_node(const Member& m) {
        if (!is_identifier(m.key))
            error(m.key_place, fmt::format("{} is no node id", in_quotes(m.key)),
                  "an id is a letter or _, then letters, digits, _ and -");
        if (!m.value.is(Value::Kind::kObject)) {
            unknown_ids_.insert(m.key);
            return error(m.value.place, fmt::format("node {} is {}; it must be an object", in_quotes(m.key),
                                                    m.value.shown()));
        }
        graph_.nodes_.push_back({m.key, nullptr, m.key_place, m.value});
    }

    void apply_set_options() {
        for (const OptionValue& o : options_.set) {
            const auto dot = o.target.find('.');
            const std::string id = o.target.substr(0, dot);
            const Place place{o.option, 0, 0};
            if (dot == std::string::npos || dot + 1 == o.target.size()) {
                error(place, "it must be NODE.NAME=VALUE");
                continue;
            }
            const int index = graph_.index_of(id);
            if (index < 0) {
                error(place, "there is no node " + in_quotes(id), did_you_mean(id, ids()));
                continue;
            }
            const std::string name = o.target.substr(dot + 1);
            if (name == "type" || name == "about") {
                error(place, fmt::format("{} is neither a parameter nor an input", in_quotes(name)));
                continue;
            }
            set_member(graph_.nodes_[static_cast<std::size_t>(index)].object, name,
                       parse_option_value(o.value, o.option));
        }
    }

    static void set_member(Value& object, const std::string& key, Value value) {
        const Place place = value.place;
        const auto it = std::ranges::find(object.members, key, &Member::key);
        if (it == object.members.end())
            object.members.push_back({key, place, std::move(value)});
        else
            it->value = std::move(value);
    }

    void add_outputs() {
        for (const OptionValue& o : options_.outputs) {
            const Place place{o.option, 0, 0};
            GraphNode node{o.option, registry().find(options_.output_type), place, {}};
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
            graph_.nodes_.push_back(std::move(node));
        }
    }

    // Takes `type` and `about` out of each object and looks the type up.
    void resolve_types() {
        for (GraphNode& node : graph_.nodes_)
            if (!node.type) resolve_type(node);
        std::erase_if(graph_.nodes_, [&](const GraphNode& n) {
            if (!n.type) unknown_ids_.insert(n.id);
            return !n.type;
        });
    }

    void resolve_type(GraphNode& node) {
        const std::string title = "node '" + node.id + "'";
        const Value* type = node.object.find("type");
        if (!type)
            error(node.place, "'type' is missing", {}, title);
        else if (!type->is(Value::Kind::kString))
            error(type->place, fmt::format("'type' is {}; it must be a string", type->shown()), {}, title);
        else if (!(node.type = registry().find(type->text)))
            error(type->place, "there is no node type " + in_quotes(type->text), near_type(type->text),
                  title);
        const Value* about = node.object.find("about");
        if (about && !about->is(Value::Kind::kString))
            error(about->place, fmt::format("'about' is {}; it must be a string", about->shown()), {}, title);
        std::erase_if(node.object.members,
                      [](const Member& m) { return m.key == "type" || m.key == "about"; });
    }

    static std::string near_type(const std::string& type) {
        std::string hint = did_you_mean(type, registry().names());
        return hint.empty() ? "'keyline nodes' lists those there are" : hint;
    }

    std::string near_node(const std::string& id) const {
        constexpr std::size_t kMostListed = 12;
        std::string hint = did_you_mean(id, ids());
        if (!hint.empty()) return hint;
        std::vector<std::string> readable;
        for (const GraphNode& n : graph_.nodes_)
            if (n.type && n.type->kind != NodeKind::kSink) readable.push_back(n.id);
        return readable.empty() || readable.size() > kMostListed ? "" : "known are " + listed(readable);
    }

    std::vector<std::string> ids() const {
        std::vector<std::string> out;
        for (const GraphNode& n : graph_.nodes_) out.push_back(n.id);
        return out;
    }

    // Parameters, then links.  The frame is that of the files on disk; it matters only where ${frame} is a
    // parameter, and each later frame is checked again.
    void check_nodes() {
        const int frame = graph_.first_frame_on_disk().value_or(1);
        graph_.at(frame, diagnostics_);
        graph_.links_.resize(graph_.nodes_.size());
        for (std::size_t i = 0; i < graph_.nodes_.size(); ++i) {
            Diagnostics ignored;  // at() told them
            const GraphNode& node = graph_.nodes_[i];
            const Value object = graph_.variables_->substitute(node.object, frame, ignored);
            for (const FieldInfo& f : node.type->fields)
                if (const Value* v = object.find(f.name))
                    check_links(i, f.type, *v);
                else if (f.required && f.type.kind == TypeInfo::Kind::kInput)
                    links_known_ = false;
        }
        find_cycles();
    }

    // From the declaration, so that the inputs of a node are checked whatever else is wrong with it.
    void check_links(std::size_t i, const TypeInfo& type, const Value& v) {
        switch (type.kind) {
            case TypeInfo::Kind::kInput: return check_link(i, v);
            case TypeInfo::Kind::kList:
                for (const Value& item : v.items) check_links(i, type.items[0], item);
                return;
            case TypeInfo::Kind::kMap:
                for (const Member& m : v.members) check_links(i, type.items[0], m.value);
                return;
            case TypeInfo::Kind::kObject:
                for (const FieldInfo& f : type.fields)
                    if (const Value* member = v.find(f.name)) check_links(i, f.type, *member);
                return;
            default: return;
        }
    }

    void check_link(std::size_t i, const Value& v) {
        Diagnostics ignored;  // at() told them
        ParamReader reader(ignored, {}, {});
        Input in;
        Codec<Input>::parse(v, "", {}, in, reader);
        const bool told = reader.failed() || graph_.variables_->uses_faulty(v);
        const int target = told ? -1 : graph_.index_of(in.node);
        const GraphNode& from = graph_.nodes_[i];
        if (target < 0) {
            links_known_ = false;
            if (!told && !unknown_ids_.contains(in.node))
                error(in.place, "there is no node " + in_quotes(in.node), near_node(in.node), from.title());
        } else if (const GraphNode& to = graph_.nodes_[static_cast<std::size_t>(target)];
                   to.type->kind == NodeKind::kSink) {
            error(in.place, fmt::format("{} is a {}, which has no result", in_quotes(in.node), to.type->name),
                  {}, from.title());
        } else {
            graph_.links_[i].push_back(target);
        }
    }

    enum class Mark { kNew, kOpen, kDone };

    void find_cycles() {
        std::vector<Mark> marks(graph_.links_.size(), Mark::kNew);
        std::vector<int> path;
        for (std::size_t i = 0; i < graph_.links_.size(); ++i)
            if (marks[i] == Mark::kNew) visit(static_cast<int>(i), marks, path);
    }

    // Depth first with a stack of its own, so that a long chain can't overflow the program's.
    void visit(int start, std::vector<Mark>& marks, std::vector<int>& path) {
        std::vector<std::size_t> next;
        const auto open = [&](int node) {
            marks[static_cast<std::size_t>(node)] = Mark::kOpen;
            path.push_back(node);
            next.push_back(0);
        };
        open(start);
        while (!path.empty()) {
            const auto& links = graph_.links_[static_cast<std::size_t>(path.back())];
            if (next.back() == links.size()) {
                marks[static_cast<std::size_t>(path.back())] = Mark::kDone;
                graph_.order_.push_back(path.back());
                path.pop_back();
                next.pop_back();
                continue;
            }
            const int target = links[next.back()++];
            const Mark mark = marks[static_cast<std::size_t>(target)];
            if (mark == Mark::kOpen) report_cycle(target, path);
            if (mark == Mark::kNew) open(target);
        }
    }

    void report_cycle(int first, const std::vector<int>& path) {
        std::vector<int> members(std::ranges::find(path, first), path.end());
        // Told from the member that stands first in the file, along the inputs.
        std::ranges::rotate(members, std::ranges::min_element(members));
        std::string chain;
        for (const int m : members)
            chain += in_quotes(graph_.nodes_[static_cast<std::size_t>(m)].id) + " needs ";
        const GraphNode& node = graph_.nodes_[static_cast<std::size_t>(members.front())];
        error(node.place, "the nodes form a cycle: " + chain + in_quotes(node.id), {}, node.title());
    }

    void choose_sinks() {
        const std::size_t first_output = graph_.nodes_.size() - options_.outputs.size();
        bool any = false;
        for (std::size_t i = 0; i < graph_.nodes_.size(); ++i) {
            if (graph_.nodes_[i].type->kind != NodeKind::kSink) continue;
            any = true;
            if (is_chosen(i, first_output)) graph_.sinks_.push_back(static_cast<int>(i));
        }
        if (!any) links_known_ = false;
        if (!any && unknown_ids_.empty())
            error(root_place_, "the graph writes nothing", "add a node of type " + sink_types());
        check_only();
        warn_of_unused();
    }

    bool is_chosen(std::size_t i, std::size_t first_output) const {
        if (!options_.outputs.empty()) return i >= first_output;
        return options_.only.empty() ||
               std::ranges::find(options_.only, graph_.nodes_[i].id) != options_.only.end();
    }

    static std::string sink_types() {
        std::vector<std::string> names;
        for (const auto& [name, type] : registry().types())
            if (type.kind == NodeKind::kSink) names.push_back(name);
        return listed(names);
    }

    void check_only() {
        std::vector<std::string> sinks;
        for (const GraphNode& n : graph_.nodes_)
            if (n.type->kind == NodeKind::kSink) sinks.push_back(n.id);
        for (const std::string& id : options_.only) {
            if (std::ranges::find(sinks, id) != sinks.end()) continue;
            std::string hint = did_you_mean(id, sinks);
            if (hint.empty() && !sinks.empty()) hint = "the graph writes with " + listed(sinks);
            error({"--only " + id, 0, 0}, fmt::format("{} is no output of the graph", in_quotes(id)), hint);
        }
    }

    void warn_of_unused() {
        if (!options_.outputs.empty() || !options_.only.empty() || !links_known_ || !unknown_ids_.empty())
            return;
        const std::vector<int> in_use = graph_.nodes_in_use();
        const std::set<int> used(in_use.begin(), in_use.end());
        for (std::size_t i = 0; i < graph_.nodes_.size(); ++i)
            if (!used.contains(static_cast<int>(i)))
                diagnostics_.warning({ErrorKind::kGraph,
                                      graph_.nodes_[i].place,
                                      graph_.nodes_[i].title(),
                                      "nothing that is written uses it; it is not run",
                                      {}});
    }

    Place root_place_;
    Graph& graph_;
    const LoadOptions& options_;
    Diagnostics& diagnostics_;
    bool links_known_ = true;            // else a node may be in use that does not look so
    std::set<std::string> unknown_ids_;  // nodes whose type is wrong: told once, not again by their users
};

std::unique_ptr<const Graph> Graph::parse(std::string_view text, const std::string& name,
                                          const std::filesystem::path& folder, const LoadOptions& options,
                                          Diagnostics& diagnostics) {
    auto graph = parse_what_is_sound(text, name, folder, options, diagnostics);
    return diagnostics.ok() ? std::move(graph) : nullptr;
}

std::unique_ptr<const Graph> Graph::parse_what_is_sound(std::string_view text, const std::string& name,
                                                        const std::filesystem::path& folder,
                                                        const LoadOptions& options,
                                                        Diagnostics& diagnostics) {
    auto graph = std::make_unique<Graph>();
    graph->folder_ = options.root.empty() ? folder : options.root;
    graph->has_root_ = !options.root.empty();
    try {
        GraphLoader(*graph, options, diagnostics).load(parse_json(text, name));
    } catch (const Failure& f) {
        diagnostics.error(f.error());
    }
    diagnostics.sort_by_place();
    return graph->links_.empty() ? nullptr : std::move(graph);
}

}  // namespace keyline
