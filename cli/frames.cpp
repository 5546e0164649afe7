// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/frames.h"

#include "engine/frames.h"

#include <fmt/format.h>

namespace keyline::cli {

namespace {

// Several frames into one file.
void refuse_fixed_outputs(const Graph& graph, const std::vector<int>& frames, Diagnostics& diagnostics) {
    if (frames.size() < 2) return;
    for (const int sink : graph.sinks()) {
        if (graph.names_frame(sink)) continue;
        const GraphNode& node = graph.nodes()[static_cast<std::size_t>(sink)];
        const Value* file = node.object.find("file");
        diagnostics.error({ErrorKind::kGraph, file ? file->place : node.place, node.title(),
                           fmt::format("frames {} would all be written to {}", format_frames(frames),
                                       file ? file->shown() : "one file"),
                           "a run of # in the name stands for the frame, as in \"out.####.exr\""});
    }
}

}  // namespace

std::vector<int> frames_to_render(const Graph& graph, const std::vector<int>& given,
                                  Diagnostics& diagnostics) {
    refuse_fixed_outputs(graph, given, diagnostics);
    if (!given.empty()) return given;
    for (const int i : graph.nodes_in_use()) {
        if (!graph.uses_frame(i)) continue;
        const GraphNode& node = graph.nodes()[static_cast<std::size_t>(i)];
        diagnostics.error({ErrorKind::kGraph, node.place, node.title(),
                           graph.names_frame(i) ? "its file name holds the frame number" : "it uses ${frame}",
                           "say which frames with --frames, as in --frames 1-24"});
    }
    return {1};
}

std::vector<int> frames_to_check(const Graph& graph, const std::vector<int>& given, std::string& note,
                                 Diagnostics& diagnostics) {
    refuse_fixed_outputs(graph, given, diagnostics);
    if (!given.empty()) return given;
    bool uses_frame = false;
    for (const int i : graph.nodes_in_use()) uses_frame = uses_frame || graph.uses_frame(i);
    if (!uses_frame) return {1};
    const std::optional<int> first = graph.first_frame_on_disk();
    note = first ? fmt::format("frame {}, the first on disk; --frames chooses another", *first)
                 : "frame 1, as no frame of the inputs was found on disk; --frames chooses another";
    return {first.value_or(1)};
}

}  // namespace keyline::cli
