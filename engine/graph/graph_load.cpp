// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/graph/check_links.h"
#include "engine/graph/choose_sinks.h"
#include "engine/graph/graph.h"
#include "engine/graph/read_nodes.h"
#include "engine/json/json_reader.h"

namespace keyline {

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
    try {
        return of_what_is_sound(parse_json(text, name), folder, options, diagnostics);
    } catch (const Failure& f) {
        diagnostics.error(f.error());
        return nullptr;
    }
}

std::unique_ptr<const Graph> Graph::of_what_is_sound(const Value& root, const std::filesystem::path& folder,
                                                     const LoadOptions& options, Diagnostics& diagnostics) {
    auto graph = std::make_unique<Graph>();
    graph->folder_ = options.root.empty() ? folder : options.root;
    graph->has_root_ = !options.root.empty();
    graph->build(root, options, diagnostics);
    diagnostics.sort_by_place();
    return graph->links_.empty() ? nullptr : std::move(graph);
}

void Graph::build(const Value& root, const LoadOptions& options, Diagnostics& diagnostics) {
    std::optional<ReadGraph> read = read_nodes(root, options, folder_, diagnostics);
    if (!read || (read->nodes.empty() && !diagnostics.ok())) return;
    nodes_ = std::move(read->nodes);
    groups_ = std::move(read->groups);
    group_files_ = std::move(read->group_files);
    scope_ = read->scope;
    path_map_ = options.path_map;
    if (!read->ocio.empty()) ocio_ = folder_ / path_map_.map(read->ocio);

    // It matters only where a parameter depends on the frame, and each later frame is checked again.
    const int frame = options.frame ? *options.frame : first_frame().value_or(1);
    const std::vector<int> inside_of_faulty = check_groups(frame, diagnostics);
    misfits_.insert(inside_of_faulty.begin(), inside_of_faulty.end());
    for (int i = 0; i < static_cast<int>(nodes_.size()); ++i)
        if (!misfits_.contains(i)) at(i, frame, diagnostics);
    for (int i = 0; i < static_cast<int>(nodes_.size()); ++i) is_enabled(i, frame, diagnostics);
    Links links = check_links(nodes_, read->unknown_ids, frame, diagnostics);
    links_ = std::move(links.of);
    misfits_.merge(links.misfits);
    order_ = order_by_links(nodes_, links_, diagnostics);

    check_enabled(*this, frame, diagnostics);
    sinks_ = choose_sinks(nodes_, options, diagnostics);
    std::erase_if(sinks_, [&](int sink) { return is_never_enabled(sink); });
    const bool writes = has_sink(nodes_);
    const bool all_known = read->unknown_ids.empty();
    if (!writes && all_known) report_no_sink(root.place, diagnostics);
    if (writes && all_known && links.known && options.outputs.empty() && options.only.empty())
        warn_of_unused(*this, diagnostics);
    if (diagnostics.ok() && options.set.empty()) warn_of_unused_variables(root, *this, diagnostics);
}

}  // namespace keyline
