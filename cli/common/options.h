// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cli/common/command_line.h"
#include "cli/common/machine.h"
#include "engine/run/render.h"

#include <chrono>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

// What render, check and plan share: the options as typed, and what they mean.

namespace keyline::cli {

struct GraphArguments {
    std::string graph;
    std::string frames, root, ocio, path_map;
    std::vector<std::string> set, var, vars, only, output;
    std::string threads, tile, memory;
    std::string added;  // nodes of the command's own making (LoadOptions)
};

// The graph, and which of its nodes and frames with which values.
void add_graph_options(const Command& command, GraphArguments& arguments);

// The same without the graph.
void add_graph_value_options(const Command& command, GraphArguments& arguments);

// --threads, --tile and --memory.
void add_machine_options(const Command& command, GraphArguments& arguments);

struct LoadedGraph {
    std::unique_ptr<const Graph> graph;  // null where there was an error; the diagnostics have it
    RenderOptions options;               // frames as typed: none without --frames
    bool no_frames = false;              // --frames names a list, and there is none in it
    Share threads, memory;               // what decided them
};

// Reads the options and the graph; whatever is wrong with either is told.
LoadedGraph load_graph(const GraphArguments& arguments, Diagnostics& diagnostics);

// What is sound of the graph, whatever else is wrong; null where not even nodes were found.  Tells nothing.
std::unique_ptr<const Graph> load_quietly(const GraphArguments& arguments);

// As a shell takes it for one word.
std::string shell_word(const std::string& text);

// "GRAPH --set … --var …": what says what is rendered, as one types it in a shell; without --frames.
std::string options_text(const GraphArguments& arguments);

// "keyline render GRAPH" with the options that say what is rendered, as one types it in a shell; without
// --frames.
std::string command_of(const GraphArguments& arguments);

// "512M", "1.5G", "4096": bytes, with powers of 1024.  Throws Failure (kGraph) for anything else and for 0.
std::size_t parse_size(const std::string& text);

// "90s", "10m", "1.5h", "600": seconds.  Throws Failure (kGraph) for anything else, and beyond a week.
std::chrono::milliseconds parse_duration(const std::string& text);

// A whole number of an option.  Throws Failure (kGraph) for anything else and out of range.
int parse_count(const std::string& text, int least, int most);

}  // namespace keyline::cli
