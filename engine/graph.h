// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/node_type.h"
#include "engine/variables.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace keyline {

// A value from the command line and the option as typed, which errors name as its place.
struct OptionValue {
    std::string target;  // "NODE.NAME", a variable's name, or "NODE[:NAME]"
    std::string value;
    std::string option;  // "--set smooth.sigma=3"
};

struct LoadOptions {
    std::vector<OptionValue> set;      // NODE.NAME = JSON or text
    std::vector<OptionValue> var;      // NAME = JSON or text
    std::vector<OptionValue> outputs;  // NODE[:NAME] = FILE; where given, these are written and nothing else
    std::string output_type;           // the sink that `outputs` are made with
    std::vector<std::string> only;     // just these sinks
    std::filesystem::path root;        // what relative paths are relative to; empty: the graph's folder
};

struct GraphNode {
    std::string id;
    const NodeType* type = nullptr;
    Place place;   // of the id
    Value object;  // inputs and parameters as written, without `type` and `about`

    // "node 'edges' (hysteresis)"; one that --output made is called as the option was typed.
    std::string title() const {
        return place.line == 0 ? place.file : "node '" + id + "' (" + type->name + ")";
    }
};

// A graph's nodes with their parameters parsed for one frame, index for index.
using FrameNodes = std::vector<std::shared_ptr<const Node>>;

// The nodes of a graph file, checked as far as that goes without opening an image.  Immutable.
class Graph {
public:
    // Null where an error was found; every error is told.
    static std::unique_ptr<const Graph> load(const std::filesystem::path& file, const LoadOptions& options,
                                             Diagnostics& diagnostics);
    // The same, but what is sound of a faulty graph is returned too, to find out what else is wrong: nodes
    // with faults have no entry in at(), and links may lead nowhere.  Null where not even nodes were found.
    static std::unique_ptr<const Graph> load_what_is_sound(const std::filesystem::path& file,
                                                           const LoadOptions& options,
                                                           Diagnostics& diagnostics);
    // load() from text; `name` stands for the file in messages, relative paths are relative to `folder`.
    static std::unique_ptr<const Graph> parse(std::string_view text, const std::string& name,
                                              const std::filesystem::path& folder, const LoadOptions& options,
                                              Diagnostics& diagnostics);

    std::span<const GraphNode> nodes() const { return nodes_; }
    int index_of(std::string_view id) const;  // -1 where there is none

    // The nodes to be written, in the file's order.
    const std::vector<int>& sinks() const { return sinks_; }

    // Every node after those it reads.
    const std::vector<int>& order() const { return order_; }
    // The nodes that a node reads.
    const std::vector<int>& links(int node) const { return links_[static_cast<std::size_t>(node)]; }

    // The sinks and what they need, directly or not, each after those it reads.
    std::vector<int> nodes_in_use() const;

    // The OpenColorIO config that the graph names; empty where it names none.
    const std::filesystem::path& ocio() const { return ocio_; }

    // The parameters for a frame.  Faults go to the diagnostics and leave a null entry.
    FrameNodes at(int frame, Diagnostics& diagnostics) const;

    // Whether a file name of the node holds the frame number.
    bool names_frame(int node) const;

    // Whether the node depends on the frame's number: in a file name, or by ${frame} anywhere else.
    bool uses_frame(int node) const;

    // The first frame that some source finds on disk; nothing where no file name holds the frame.
    std::optional<int> first_frame_on_disk() const;

private:
    static std::unique_ptr<const Graph> parse_what_is_sound(std::string_view text, const std::string& name,
                                                            const std::filesystem::path& folder,
                                                            const LoadOptions& options,
                                                            Diagnostics& diagnostics);

    friend class GraphLoader;
    std::vector<GraphNode> nodes_;
    std::vector<int> sinks_, order_;
    std::vector<std::vector<int>> links_;
    std::optional<Variables> variables_;
    std::filesystem::path ocio_;
    std::filesystem::path folder_;  // what relative paths are relative to
    bool has_root_ = false;         // …those from the command line too
};

}  // namespace keyline
