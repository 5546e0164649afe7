// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/graph/expand_groups.h"

#include "engine/base/identifier.h"
#include "engine/graph/any_node.h"
#include "engine/graph/apply_options.h"
#include "engine/graph/enabled.h"
#include "engine/graph/graph_error.h"
#include "engine/graph/group.h"
#include "engine/graph/group_search.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace keyline {

namespace {

class Expansion {
public:
    Expansion(const LoadOptions& options, ReadGraph& read, Diagnostics& diagnostics)
        : options_(options), read_(read), diagnostics_(diagnostics) {}

    // From front to back; what a group brings in comes at the end, and has its turn.
    void run(const std::shared_ptr<Scope>& scope) {
        scopes_[""] = scope;
        for (std::size_t i = 0; i < read_.nodes.size(); ++i)
            if (const Value* type = read_.nodes[i].object.find("type");
                type && type->is(Value::Kind::kString))
                if (const auto file = group_file(type->text, folder_of(i)); !file.empty())
                    expand(i, Value(*type), file);  // nodes move when others come
        std::erase_if(read_.nodes, [&](const GraphNode& n) { return expanded_.contains(n.id); });
    }

private:
    std::filesystem::path folder_of(std::size_t i) const { return read_.nodes[i].scope->file.parent_path(); }

    void expand(std::size_t i, const Value& type, const std::filesystem::path& file) {
        apply_set_options_of(read_.nodes[i]);
        GraphNode node = read_.nodes[i];
        expanded_.insert(node.id);
        const std::size_t slash = node.id.rfind('/');
        const std::size_t own = slash == std::string::npos ? 0 : slash + 1;
        const std::shared_ptr<Scope> outer = scopes_.at(node.id.substr(0, own));
        const auto group = group_of(type, file, *outer, node);
        if (!group) {
            read_.unknown_ids.insert(node.id);
            return;
        }
        node.type = &group->type;
        take_what_any_node_has(node, node.title(), diagnostics_);
        const std::shared_ptr<Scope> inside = inside_of(*group, node, outer);
        GroupUse use{inside, outputs_of(*group)};
        if (use.outputs.empty()) read_.unknown_ids.insert(node.id);  // told where the group is read
        inside->is_enabled = is_enabled(node);
        if (!inside->is_enabled) use.passes = leading_input(*group, node);
        outer->groups[node.id.substr(own)] = std::move(use);
        add_nodes(*group, inside);
        kept_.push_back(group);
        read_.groups.push_back(std::move(node));
    }

    void apply_set_options_of(GraphNode& node) {
        std::vector<OptionValue> of_it;
        for (const OptionValue& o : options_.set)
            if (o.target.substr(0, o.target.find('.')) == node.id) of_it.push_back(o);
        std::vector<GraphNode> one{node};
        apply_set_options(of_it, one, diagnostics_);
        node = one[0];
    }

    // Links are the same at all frames, so this is too.
    bool is_enabled(const GraphNode& node) {
        if (!enabled_moves(node)) return is_enabled_at(node, 1, diagnostics_).value_or(true);
        graph_error(diagnostics_, node.enabled->place, "whether a group is enabled can't change over frames",
                    "say it of a node inside it", node.title());
        return true;
    }

    // The input that stands for what the group gives; "" where there is none, which is told.
    std::string leading_input(const Group& group, const GraphNode& node) {
        for (const FieldInfo& f : group.type.fields)
            if (group.has_input(f.name) && node.object.find(f.name)) return f.name;
        graph_error(diagnostics_, node.enabled->place,
                    "'enabled' can't leave it out: it has no input to pass on in its place",
                    "a variable in the next node's input chooses between two", node.title());
        return {};
    }

    std::shared_ptr<const Group> group_of(const Value& type, const std::filesystem::path& file,
                                          const Scope& outer, const GraphNode& node) {
        std::error_code error;
        for (const Scope* scope = &outer; scope; scope = scope->outer)
            if (std::filesystem::equivalent(scope->file, file, error)) {
                graph_error(diagnostics_, type.place,
                            fmt::format("the group {} is inside itself", in_quotes(type.text)), {},
                            "node '" + node.id + "'");
                return nullptr;
            }
        return read_group(file, type.place, diagnostics_);
    }

    std::shared_ptr<Scope> inside_of(const Group& group, const GraphNode& node,
                                     const std::shared_ptr<Scope>& outer) {
        auto inside = std::make_shared<Scope>();
        inside->prefix = node.id + "/";
        inside->file = group.file;
        inside->folder = group.file.parent_path();
        inside->outer = outer.get();
        inside->meant = node.meant;
        inside->use = fmt::format(", used at {}{}", node.place.text(), outer->use);
        Value declared;
        declared.kind = Value::Kind::kObject;
        for (const FieldInfo& f : group.type.fields) {
            const Value* given = node.object.find(f.name);
            if (f.type.kind == TypeInfo::Kind::kInput)
                inside->inputs[f.name] = given ? std::optional(*given) : std::nullopt;
            else
                declared.members.push_back({f.name, {}, given ? *given : f.default_value});
        }
        if (const Value* own = group.root.find("variables"))
            declared.members.insert(declared.members.end(), own->members.begin(), own->members.end());
        VariableSources sources;
        sources.declared = &declared;
        sources.shot = outer->variables->shot();
        sources.given = &node.object;
        sources.giver = outer->variables;
        inside->variables = std::make_shared<const Variables>(sources, diagnostics_);
        scopes_[inside->prefix] = inside;
        return inside;
    }

    static std::vector<GroupUse::Output> outputs_of(const Group& group) {
        std::vector<GroupUse::Output> out;
        for (const Group::Output& o : group.outputs) out.push_back({o.name, o.link});
        return out;
    }

    void add_nodes(const Group& group, const std::shared_ptr<Scope>& inside) {
        for (const Member& m : group.root.find("nodes")->members) {
            GraphNode node{inside->prefix + m.key, nullptr, m.key_place, m.value};
            node.object.place = m.key_place;
            node.scope = inside;
            if (!is_identifier(m.key))
                graph_error(diagnostics_, m.key_place, fmt::format("{} is no node id", in_quotes(m.key)),
                            fmt::format("an id is {}", kIdentifierForm), {}, Code::kWrongValue);
            else if (!m.value.is(Value::Kind::kObject))
                graph_error(
                    diagnostics_, m.value.place,
                    fmt::format("node {} is {}; it must be an object", in_quotes(node.id), m.value.shown()),
                    {}, {}, Code::kWrongValue);
            else
                read_.nodes.push_back(std::move(node));
        }
    }

    const LoadOptions& options_;
    ReadGraph& read_;
    Diagnostics& diagnostics_;
    std::map<std::string, std::shared_ptr<Scope>> scopes_;  // by their prefixes
    std::set<std::string> expanded_;
    std::vector<std::shared_ptr<const Group>>& kept_ = read_.group_files;
};

}  // namespace

void expand_groups(const LoadOptions& options, const std::shared_ptr<Scope>& scope, ReadGraph& read,
                   Diagnostics& diagnostics) {
    Expansion(options, read, diagnostics).run(scope);
}

}  // namespace keyline
