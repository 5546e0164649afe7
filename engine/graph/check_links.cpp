// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/graph/check_links.h"

#include "engine/graph/apply_options.h"
#include "engine/graph/graph_error.h"
#include "engine/node/kinds.h"

#include <algorithm>
#include <fmt/format.h>

namespace keyline {

namespace {

class LinkChecker {
public:
    LinkChecker(const std::vector<GraphNode>& nodes, const std::set<std::string>& unknown_ids,
                Diagnostics& diagnostics)
        : nodes_(nodes), unknown_ids_(unknown_ids), diagnostics_(diagnostics) {}

    Links check(int frame) {
        links_.of.resize(nodes_.size());
        for (std::size_t i = 0; i < nodes_.size(); ++i) {
            Diagnostics ignored;  // Graph::at() told them
            Value object = nodes_[i].variables().substitute(nodes_[i].object, frame, ignored);
            make_links_whole(*nodes_[i].scope, nodes_[i].type->fields, frame, object);
            for (const FieldInfo& f : nodes_[i].type->fields)
                if (const Value* v = object.find(f.name))
                    check_value(i, f.name, f.type, *v);
                else if (f.required && f.type.kind == TypeInfo::Kind::kInput)
                    links_.known = false;
        }
        return std::move(links_);
    }

private:
    void check_value(std::size_t i, const std::string& port, const TypeInfo& type, const Value& v) {
        switch (type.kind) {
            case TypeInfo::Kind::kInput: return check_link(i, port, type.takes, v);
            case TypeInfo::Kind::kList:
                for (const Value& item : v.items) check_value(i, port, type.items[0], item);
                return;
            case TypeInfo::Kind::kMap:
                for (const Member& m : v.members) check_value(i, m.key, type.items[0], m.value);
                return;
            case TypeInfo::Kind::kObject:
                for (const FieldInfo& f : type.fields)
                    if (const Value* member = v.find(f.name)) check_value(i, f.name, f.type, *member);
                return;
            default: return;
        }
    }

    void check_link(std::size_t i, const std::string& port, const Takes& takes, const Value& v) {
        Diagnostics ignored;  // Graph::at() told them
        ParamReader reader(ignored, {}, {});
        validate(TypeInfo::input(takes, false), v, port, reader);
        if (reader.failed() || nodes_[i].variables().uses_faulty(v)) {
            links_.known = false;
            return;
        }
        const Input in = Codec<Input>::from_value(v, {}, {});
        const auto to = std::ranges::find(nodes_, in.node, &GraphNode::id);
        if (to == nodes_.end()) {
            links_.known = false;
            if (!unknown_ids_.contains(in.node))
                error(i, in, Code::kUnknownNode, "there is no node " + in_quotes(in.node),
                      near_node(in.node));
        } else if (to->type->kind == NodeKind::kSink) {
            error(i, in, Code::kLinkKind,
                  fmt::format("{} is a {}, which has no result", in_quotes(in.node), to->type->name));
        } else {
            links_.of[i].push_back(static_cast<int>(to - nodes_.begin()));
            auto fault = kind_fault(port, takes, in.node, *to->type);
            if (!fault && !in.selector.empty()) fault = selector_fault(in.node, *to->type, in.selector);
            if (!fault) return;
            links_.misfits.insert(static_cast<int>(i));
            error(i, in, Code::kLinkKind, std::move(fault->what), std::move(fault->hint));
        }
    }

    void error(std::size_t i, const Input& in, Code code, std::string what, std::string hint = {}) {
        graph_error(diagnostics_, in.place, std::move(what), std::move(hint), nodes_[i].title(), code);
    }

    std::string near_node(const std::string& id) const {
        // As other programs part a node from its layer.
        const auto mark = id.find_first_of("./");
        if (mark != std::string::npos && std::ranges::count(ids_of(nodes_), id.substr(0, mark)) > 0)
            return fmt::format("a layer is written {}",
                               in_quotes(id.substr(0, mark) + ':' + id.substr(mark + 1)));
        std::string hint = did_you_mean(id, ids_of(nodes_));
        if (!hint.empty()) return hint;
        std::vector<std::string> readable;
        for (const GraphNode& n : nodes_)
            if (n.type->kind != NodeKind::kSink) readable.push_back(n.id);
        return readable.empty() || readable.size() > kMostListed ? "" : "known are " + listed(readable);
    }

    const std::vector<GraphNode>& nodes_;
    const std::set<std::string>& unknown_ids_;
    Diagnostics& diagnostics_;
    Links links_;
};

}  // namespace

Links check_links(const std::vector<GraphNode>& nodes, const std::set<std::string>& unknown_ids, int frame,
                  Diagnostics& diagnostics) {
    return LinkChecker(nodes, unknown_ids, diagnostics).check(frame);
}

}  // namespace keyline
