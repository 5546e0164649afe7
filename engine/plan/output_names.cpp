// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/plan/output_names.h"

#include "engine/base/index.h"

#include <algorithm>

namespace keyline {

namespace {

const Node* node_of(const FrameNodes& nodes, int i) { return nodes[index(i)].get(); }

}  // namespace

bool has_fixed_names(const Node* at_first, const Node* at_last) {
    return at_first && at_last &&
           std::ranges::equal(at_first->files(), at_last->files(), {}, &FileName::text, &FileName::text);
}

OutputNames::OutputNames(const Graph& graph, std::span<const int> frames) : graph_(graph) {
    Diagnostics ignored;  // told frame by frame
    first_ = graph.at(frames.front(), ignored);
    const FrameNodes last = graph.at(frames.back(), ignored);
    are_fixed_ = std::ranges::all_of(
        graph.sinks(), [&](int sink) { return has_fixed_names(node_of(first_, sink), node_of(last, sink)); });
}

std::vector<OutputNames::Output> OutputNames::at(int frame) const {
    Diagnostics ignored;
    const FrameNodes parsed = are_fixed_ ? FrameNodes() : graph_.at(frame, ignored);
    const FrameNodes& nodes = are_fixed_ ? first_ : parsed;
    std::vector<Output> out;
    for (const int sink : graph_.sinks()) {
        if (!graph_.is_enabled(sink, frame, ignored).value_or(true)) continue;
        const Node* node = node_of(nodes, sink);
        if (!node) return {};
        for (const FileName& file : node->files()) out.push_back({sink, file.at(frame)});
    }
    return out;
}

}  // namespace keyline
