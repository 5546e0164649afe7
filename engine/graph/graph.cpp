// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/graph/graph.h"

#include "engine/base/index.h"
#include "engine/graph/enabled.h"
#include "engine/graph/read_text.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <set>

namespace keyline {

namespace {

bool stands_in(const Place& place, const Value& value) {
    const auto holds = [&](const Value& v) { return stands_in(place, v); };
    return value.place == place || std::ranges::any_of(value.items, holds) ||
           std::ranges::any_of(value.members, holds, &Member::value);
}

}  // namespace

std::unique_ptr<const Graph> Graph::load(const std::filesystem::path& file, const LoadOptions& options,
                                         Diagnostics& diagnostics) {
    auto graph = load_what_is_sound(file, options, diagnostics);
    return diagnostics.ok() ? std::move(graph) : nullptr;
}

std::unique_ptr<const Graph> Graph::load_what_is_sound(const std::filesystem::path& file,
                                                       const LoadOptions& options, Diagnostics& diagnostics) {
    try {
        return parse_what_is_sound(read_text(file, "the graph"), file.string(), file.parent_path(), options,
                                   diagnostics);
    } catch (const Failure& f) {
        diagnostics.error(f.error());
        return nullptr;
    }
}

int Graph::index_of(std::string_view id) const {
    const auto it = std::ranges::find(nodes_, id, &GraphNode::id);
    return it == nodes_.end() ? -1 : static_cast<int>(it - nodes_.begin());
}

FrameNodes Graph::at(int frame, Diagnostics& diagnostics) const {
    FrameNodes out;
    out.reserve(nodes_.size());
    for (int i = 0; i < static_cast<int>(nodes_.size()); ++i) out.push_back(at(i, frame, diagnostics));
    return out;
}

namespace {

// The members of a node's object as they are for a moment.
struct Members {
    Value object;                             // without those that are not known yet
    std::vector<Value> faulty = {};           // what is wrong with these was told
    std::vector<const Member*> unsized = {};  // as written: they depend on sizes, which are not known yet
};

// What is declared for a member; what is not declared is text.
const TypeInfo& type_of(const GraphNode& node, const std::string& name) {
    static const TypeInfo kText = TypeInfo::string();
    const auto field = std::ranges::find(node.type->fields, name, &FieldInfo::name);
    return field == node.type->fields.end() ? kText : field->type;
}

// What is linked and opened must be known before any size is.
bool may_wait(const TypeInfo& type) {
    return type.kind != TypeInfo::Kind::kInput && type.kind != TypeInfo::Kind::kFile;
}

Members members_at(const GraphNode& node, const Moment& moment, const PathMap& path_map,
                   Diagnostics& faults) {
    const Variables& variables = node.variables();
    Members out{node.object};
    out.object.members.clear();
    for (const Member& m : node.object.members) {
        const TypeInfo& type = type_of(node, m.key);
        const std::size_t before = faults.errors().size();
        const bool faulty = variables.uses_faulty(m.value, &type);
        if (!moment.sizes && !faulty && may_wait(type) && variables.uses_sizes(m.value, type)) {
            variables.check(m.value, type, faults);
            out.unsized.push_back(&m);
            continue;
        }
        Value value = variables.evaluate(m.value, type, moment, faults);
        const bool is_path = type.kind == TypeInfo::Kind::kFile && value.is(Value::Kind::kString);
        if (is_path) value.text = path_map.map(value.text);
        out.object.members.push_back({m.key, m.key_place, std::move(value)});
        if (faulty || faults.errors().size() > before) out.faulty.push_back(out.object.members.back().value);
    }
    make_links_whole(*node.scope, node.type->fields, *moment.frame, out.object);
    return out;
}

// Null where a fault was told, and where a required parameter is not known yet.  What is wrong between
// parameters is told when all are known.
std::unique_ptr<const Node> make_node(const NodeType& type, const Members& members, ParamReader& reader) {
    if (members.unsized.empty() && type.make) return type.parse(members.object, reader);
    std::vector<FieldInfo> known;
    bool is_whole = true;
    for (const FieldInfo& f : type.fields) {
        const auto has_name = [&](const Member* m) { return m->key == f.name; };
        if (std::ranges::none_of(members.unsized, has_name))
            known.push_back(f);
        else
            is_whole = is_whole && !f.required;
    }
    validate(known, members.object, reader);
    if (!type.make) return nullptr;  // a group
    Diagnostics later;
    ParamReader quiet(later, {}, reader.base());
    return is_whole && !reader.failed() ? type.make(type.fields, members.object, quiet) : nullptr;
}

// The first link in a value of a type; null: there is none.
const Value* first_link(const TypeInfo& type, const Value& value) {
    if (type.kind == TypeInfo::Kind::kInput) return value.is(Value::Kind::kString) ? &value : nullptr;
    const bool is_list = type.kind == TypeInfo::Kind::kList && !value.items.empty();
    return is_list ? first_link(type.items[0], value.items[0]) : nullptr;
}

}  // namespace

std::shared_ptr<const Node> Graph::at(int index, int frame, Diagnostics& diagnostics,
                                      const InputSizes* sizes) const {
    auto parsed = make(nodes_[static_cast<std::size_t>(index)], {frame, sizes}, diagnostics);
    return misfits_.contains(index) ? nullptr : std::move(parsed);
}

std::vector<int> Graph::check_groups(int frame, Diagnostics& diagnostics) const {
    std::vector<int> out;
    for (const GraphNode& group : groups_) {
        const std::size_t before = diagnostics.errors().size();
        make(group, {frame}, diagnostics);
        if (diagnostics.errors().size() == before) continue;
        for (int i = 0; i < static_cast<int>(nodes_.size()); ++i)
            if (nodes_[static_cast<std::size_t>(i)].id.starts_with(group.id + "/")) out.push_back(i);
    }
    return out;
}

std::unique_ptr<const Node> Graph::make(const GraphNode& node, const Moment& moment,
                                        Diagnostics& diagnostics) const {
    Diagnostics faults;
    const Members members = members_at(node, moment, path_map_, faults);
    ParamReader reader(faults, node.title(), path_base(node));
    if (!members.unsized.empty() && !leading_input_of(node, *moment.frame))
        reader.error(members.unsized[0]->value.place,
                     fmt::format("'{}' depends on the size of an input, and none is connected",
                                 members.unsized[0]->key));
    auto parsed = make_node(*node.type, members, reader);
    for (Error e : faults.errors()) {
        const bool follows = !e.node.empty() && std::ranges::any_of(members.faulty, [&](const Value& v) {
            return stands_in(e.place, v);
        });
        if (follows) continue;
        if (e.node.empty()) e.node = node.title();
        diagnostics.error(std::move(e));
    }
    if (!faults.ok() || !members.faulty.empty()) return nullptr;
    return parsed;
}

bool Graph::uses_sizes(int index) const {
    const GraphNode& node = nodes_[static_cast<std::size_t>(index)];
    return std::ranges::any_of(node.object.members, [&](const Member& m) {
        return node.variables().uses_sizes(m.value, type_of(node, m.key));
    });
}

std::optional<Input> Graph::leading_input(int node, int frame) const {
    return leading_input_of(nodes_[static_cast<std::size_t>(node)], frame);
}

namespace {

std::optional<Value> whole(Value link, const Scope& scope, int frame) {
    const auto text = whole_link(scope, link.text, frame);
    if (text) link.text = *text;
    return text ? std::optional(std::move(link)) : std::nullopt;
}

}  // namespace

std::optional<Input> Graph::leading_input_of(const GraphNode& node, int frame) {
    Diagnostics ignored;  // at() tells them
    std::optional<Value> first;
    for (const FieldInfo& f : node.type->fields) {
        const Value* given = node.object.find(f.name);
        if (!given || (first && !f.type.leading)) continue;
        const Value value = node.variables().evaluate(*given, f.type, {frame}, ignored);
        if (const Value* link = first_link(f.type, value)) first = whole(*link, *node.scope, frame);
    }
    ParamReader reader(ignored, {}, {});
    if (first) validate(TypeInfo::input({}, false), *first, {}, reader);
    if (!first || reader.failed()) return std::nullopt;
    return Codec<Input>::from_value(*first, {}, {});
}

std::optional<bool> Graph::is_enabled(int index, int frame, Diagnostics& diagnostics) const {
    return is_enabled_at(nodes_[static_cast<std::size_t>(index)], frame, diagnostics);
}

bool Graph::is_never_enabled(int index) const {
    Diagnostics ignored;  // they were told
    const GraphNode& node = nodes_[static_cast<std::size_t>(index)];
    return node.enabled && !enabled_moves(node) && !is_enabled(index, 1, ignored).value_or(true);
}

bool Graph::names_frame(int node) const {
    const GraphNode& n = nodes_[static_cast<std::size_t>(node)];
    const auto names_it = [&](const FieldInfo& f) {
        const Value* v = f.type.kind == TypeInfo::Kind::kFile ? n.object.find(f.name) : nullptr;
        return v && n.variables().uses_frame(*v, &f.type);
    };
    if (std::ranges::any_of(n.type->fields, names_it)) return true;
    Diagnostics ignored;  // load() told them
    const auto parsed = at(node, 1, ignored);
    return parsed && std::ranges::any_of(parsed->files(), &FileName::has_frame);
}

bool Graph::uses_frame(int node) const {
    const GraphNode& n = nodes_[static_cast<std::size_t>(node)];
    return names_frame(node) || enabled_moves(n) ||
           std::ranges::any_of(n.object.members, [&](const Member& m) {
               const TypeInfo& type = type_of(n, m.key);
               return n.variables().uses_frame(m.value, &type);
           });
}

std::vector<int> Graph::nodes_in_use() const {
    std::vector<bool> used(nodes_.size(), false);
    for (const int sink : sinks_) used[index(sink)] = true;
    for (auto it = order_.rbegin(); it != order_.rend(); ++it)
        if (used[index(*it)])
            for (const int target : links(*it)) used[index(target)] = true;
    std::vector<int> out;
    std::ranges::copy_if(order_, std::back_inserter(out), [&](int node) { return used[index(node)]; });
    return out;
}

std::optional<int> Graph::first_frame_on_disk() const {
    std::optional<int> first;
    for (const GraphNode& node : nodes_)
        if (const std::vector<int> frames = frames_on_disk(node); !frames.empty())
            first = std::min(first.value_or(frames.front()), frames.front());
    return first;
}

std::optional<int> Graph::first_frame() const {
    const std::optional<int> said = variables().shot().first;
    return said ? said : first_frame_on_disk();
}

std::vector<int> Graph::frames_on_disk() const {
    std::set<int> out;
    for (const int i : nodes_in_use())
        for (const int frame : frames_on_disk(nodes_[index(i)])) out.insert(frame);
    return {out.begin(), out.end()};
}

std::vector<int> Graph::frames_on_disk(const GraphNode& node) const {
    if (node.type->kind != NodeKind::kSource) return {};
    Diagnostics ignored;  // load() tells them
    const auto parsed = make(node, {1}, ignored);
    if (!parsed) return {};
    std::set<int> out;
    for (const FileName& file : parsed->files())
        for (const int frame : file.frames_on_disk()) out.insert(frame);
    return {out.begin(), out.end()};
}

}  // namespace keyline
