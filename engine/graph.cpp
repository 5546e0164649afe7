// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/graph.h"

#include <algorithm>
#include <cerrno>
#include <fmt/format.h>
#include <fstream>
#include <sstream>

namespace keyline {

namespace {

std::string read_text(const std::filesystem::path& file) {
    std::error_code error;
    const auto cannot = [&](const std::string& why) {
        fail(ErrorKind::kGraph, fmt::format("cannot read the graph {}: {}", in_quotes(file.string()), why));
    };
    if (std::filesystem::is_directory(file, error)) cannot("it is a folder");
    std::ifstream in(file, std::ios::binary);
    if (!in) cannot(std::generic_category().message(errno));
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

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
        return parse_what_is_sound(read_text(file), file.string(), file.parent_path(), options, diagnostics);
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
    for (const GraphNode& node : nodes_) {
        Diagnostics faults;
        std::vector<const Value*> unknown;  // values that a faulty variable leaves open
        Value object = node.object;
        for (Member& m : object.members) {
            const std::size_t before = faults.errors().size();
            const bool faulty = variables_->uses_faulty(m.value);
            m.value = variables_->substitute(m.value, frame, faults);
            if (faulty || faults.errors().size() > before) unknown.push_back(&m.value);
        }
        ParamReader reader(faults, node.title(), {folder_, has_root_});
        auto parsed = node.type->parse(object, reader);
        for (Error e : faults.errors()) {
            const bool follows = !e.node.empty() && std::ranges::any_of(unknown, [&](const Value* v) {
                return stands_in(e.place, *v);
            });
            if (follows) continue;
            if (e.node.empty()) e.node = node.title();
            diagnostics.error(std::move(e));
        }
        out.push_back(faults.ok() && unknown.empty() ? std::move(parsed) : nullptr);
    }
    return out;
}

bool Graph::names_frame(int node) const {
    const GraphNode& n = nodes_[static_cast<std::size_t>(node)];
    Diagnostics ignored;  // load() told them
    ParamReader reader(ignored, {}, {folder_, has_root_});
    const auto parsed = n.type->parse(variables_->substitute(n.object, 1, ignored), reader);
    if (!parsed || parsed->files().empty()) return false;
    return std::ranges::any_of(parsed->files(), &FileName::has_frame) || variables_->uses_frame(n.object);
}

bool Graph::uses_frame(int node) const {
    return names_frame(node) || variables_->uses_frame(nodes_[static_cast<std::size_t>(node)].object);
}

std::vector<int> Graph::nodes_in_use() const {
    std::vector<bool> used(nodes_.size(), false);
    for (const int sink : sinks_) used[static_cast<std::size_t>(sink)] = true;
    for (auto it = order_.rbegin(); it != order_.rend(); ++it)
        if (used[static_cast<std::size_t>(*it)])
            for (const int target : links(*it)) used[static_cast<std::size_t>(target)] = true;
    std::vector<int> out;
    std::ranges::copy_if(order_, std::back_inserter(out),
                         [&](int node) { return used[static_cast<std::size_t>(node)]; });
    return out;
}

std::optional<int> Graph::first_frame_on_disk() const {
    std::optional<int> first;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        if (nodes_[i].type->kind != NodeKind::kSource) continue;
        Diagnostics ignored;  // load() tells them
        ParamReader reader(ignored, {}, {folder_, has_root_});
        const auto parsed =
            nodes_[i].type->parse(variables_->substitute(nodes_[i].object, 1, ignored), reader);
        if (!parsed) continue;
        for (const FileName& file : parsed->files()) {
            const std::vector<int> frames = file.has_frame() ? file.frames_on_disk() : std::vector<int>{};
            if (!frames.empty()) first = std::min(first.value_or(frames.front()), frames.front());
        }
    }
    return first;
}

}  // namespace keyline
