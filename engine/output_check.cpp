// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/output_check.h"

#include "engine/demand.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <set>

namespace keyline {

namespace {

// The same for all names of one file, whether it is there yet or not.
std::string identity_of(const std::filesystem::path& file) {
    std::error_code error;
    const auto canonical = std::filesystem::weakly_canonical(std::filesystem::absolute(file), error);
    return error ? file.string() : canonical.string();
}

// The files that a frame reads pixels of; nodes that no sink needs read none.
std::vector<std::filesystem::path> inputs_of(const ResolvedFrame& frame) {
    const Demand demanded = demand(frame);
    std::vector<std::filesystem::path> out;
    for (std::size_t i = 0; i < frame.ops.size(); ++i)
        if (frame.ops[i].source && demanded.needs(i)) out.push_back(frame.ops[i].source->header().file);
    return out;
}

// The outputs of all frames, and the sink that makes each.
std::map<std::string, int> outputs_of(const Graph& graph, std::span<const int> frames) {
    std::map<std::string, int> out;
    Diagnostics ignored;  // told frame by frame
    for (const int frame : frames) {
        const FrameNodes nodes = graph.at(frame, ignored);
        for (const int sink : graph.sinks())
            if (const Node* node = nodes[static_cast<std::size_t>(sink)].get())
                for (const FileName& file : node->files()) out.emplace(identity_of(file.at(frame)), sink);
    }
    return out;
}

// An output that some frame of some source has the name of; "" for none.
std::string output_with_name_of_input(const Graph& graph, std::span<const int> frames,
                                      const std::map<std::string, int>& outputs) {
    Diagnostics ignored;
    const FrameNodes nodes = graph.at(frames.front(), ignored);
    for (const int i : graph.nodes_in_use()) {
        const auto index = static_cast<std::size_t>(i);
        if (graph.nodes()[index].type->kind != NodeKind::kSource || !nodes[index]) continue;
        for (const FileName& file : nodes[index]->files()) {
            std::vector<int> candidates = file.frames_on_disk();
            candidates.insert(candidates.end(), frames.begin(), frames.end());
            for (const int frame : candidates)
                if (outputs.contains(identity_of(file.at(frame)))) return identity_of(file.at(frame));
        }
    }
    return {};
}

}  // namespace

void check_outputs(const ResolvedFrame& frame, Diagnostics& diagnostics) {
    std::map<std::string, std::string> taken;  // file → who uses it
    for (const auto& file : inputs_of(frame)) taken.emplace(identity_of(file), "read by this run");
    for (const Sink& sink : frame.sinks) {
        const auto [it, is_new] =
            taken.emplace(identity_of(sink.request.file), "written by " + sink.title + " too");
        if (!is_new)
            diagnostics.error({ErrorKind::kGraph, sink.place, sink.title,
                               fmt::format("{} is {}", in_quotes(sink.request.file.string()), it->second),
                               "write to another file"});
    }
}

void check_outputs(const Graph& graph, std::span<const int> frames, const ResolveOptions& options,
                   Diagnostics& diagnostics) {
    if (frames.size() < 2) return;
    const std::map<std::string, int> outputs = outputs_of(graph, frames);
    const std::string shared = output_with_name_of_input(graph, frames, outputs);
    if (shared.empty()) return;
    const auto refuse = [&](int sink, std::string what) {
        const GraphNode& node = graph.nodes()[static_cast<std::size_t>(sink)];
        diagnostics.error(
            {ErrorKind::kGraph, node.place, node.title(), std::move(what), "write to another file"});
    };
    std::set<int> told;
    std::optional<int> unknown;
    for (const int frame : frames) {
        Diagnostics ignored;  // told when the frame's turn comes
        const auto resolved = resolve(graph, frame, options, ignored);
        if (!resolved) {
            unknown = frame;
            continue;
        }
        for (const auto& file : inputs_of(*resolved)) {
            const auto output = outputs.find(identity_of(file));
            if (output == outputs.end() || !told.insert(output->second).second) continue;
            refuse(output->second,
                   fmt::format("{} is read by frame {} of this run", in_quotes(file.string()), frame));
        }
    }
    // What can't be known is not risked: it may be the only copy of a plate.
    if (told.empty() && unknown)
        refuse(outputs.at(shared),
               fmt::format("{} may be read by this run: frame {} can't be resolved to tell",
                           in_quotes(shared), *unknown));
}

}  // namespace keyline
