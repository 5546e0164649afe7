// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/common/frames.h"

#include "engine/base/index.h"
#include "engine/graph/read_text.h"

#include <fmt/format.h>
#include <sstream>

namespace keyline::cli {

std::string frames_text(const std::string& option) {
    const bool is_file = option.starts_with('@');
    if (!is_file && option != "-") return option;
    std::istringstream lines(read_text(is_file ? option.substr(1) : option, "the list"));
    std::string out;
    for (std::string line; std::getline(lines, line);) {
        if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
        if (line.ends_with('\r')) line.pop_back();
        out += (out.empty() ? "" : ",") + line;
    }
    return out;
}

std::vector<int> frames_to_render(const Graph& graph, const std::vector<int>& given,
                                  Diagnostics& diagnostics) {
    if (!given.empty()) return given;
    for (const int i : graph.nodes_in_use()) {
        if (!graph.uses_frame(i)) continue;
        const GraphNode& node = graph.nodes()[static_cast<std::size_t>(i)];
        diagnostics.error(
            {ErrorKind::kGraph, node.place, node.title(),
             graph.names_frame(i) ? "its file name holds the frame number" : "it depends on the frame",
             "say which frames with --frames, as in --frames 1-24"});
    }
    return {1};
}

std::vector<int> frames_to_check(const Graph& graph, const std::vector<int>& given, std::string& note) {
    if (!given.empty()) return given;
    bool uses_frame = false;
    for (const int i : graph.nodes_in_use()) uses_frame = uses_frame || graph.uses_frame(i);
    if (!uses_frame) return {1};
    if (const auto said = graph.variables().shot().first) {
        note = fmt::format("frame {}, the first of the graph's; --frames chooses another", *said);
        return {*said};
    }
    const std::optional<int> first = graph.first_frame_on_disk();
    note = first ? fmt::format("frame {}, the first on disk; --frames chooses another", *first)
                 : "frame 1, as no frame of the inputs was found on disk; --frames chooses another";
    return {first.value_or(1)};
}

}  // namespace keyline::cli
