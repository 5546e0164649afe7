// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/base/index.h"
#include "engine/graph/scope.h"
#include "engine/node/node_type.h"
#include "engine/params/path_map.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace KEYLINE_API keyline {

struct Group;

// A value from the command line and the option as typed, which errors name as its place.
struct OptionValue {
    std::string target;  // "NODE.NAME", a variable's name, or "NODE[:NAME]"
    std::string value;
    std::string option;  // "--set smooth.sigma=3"
};

struct LoadOptions {
    std::vector<OptionValue> set;      // NODE.NAME = JSON or text
    std::vector<OptionValue> var;      // NAME = JSON or text
    std::vector<std::string> vars;     // files of variables
    std::vector<OptionValue> outputs;  // NODE[:NAME] = FILE; where given, these are written and nothing else
    std::string output_type;           // the sink that `outputs` are made with
    std::string added;                 // further nodes, as JSON: `{ "id": { … } }`; empty: none
    std::vector<std::string> only;     // just these sinks
    std::optional<int> frame;          // to check with; else the first of the graph's, or on disk
    std::filesystem::path root;        // what relative paths are relative to; empty: the graph's folder
    PathMap path_map;                  // where the paths of the graph and of `outputs` lie on this machine
};

struct GraphNode {
    std::string id;
    const NodeType* type = nullptr;
    Place place;                        // of the id
    Value object;                       // inputs and parameters as written, without those that any node has
    std::optional<Value> enabled = {};  // as written
    std::shared_ptr<const Scope> scope = {};  // what the names in them mean
    std::vector<Code> meant = {};             // mistakes that it says are none

    const Variables& variables() const { return *scope->variables; }

    // "node 'edges' (hysteresis)"; one that --output made is called as the option was typed.
    std::string title() const {
        return place.line == 0 ? place.file : "node '" + id + "' (" + type->name + ")" + scope->use;
    }
};

// A graph's nodes with their parameters parsed for one frame, index for index.
using FrameNodes = std::vector<std::shared_ptr<const Node>>;

// The nodes of a graph file, checked as far as that goes without opening an image.  Immutable.
class Graph {
public:
    // Null where an error was found; every error is told.  "-" is standard input, in the working directory.
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

    // load_what_is_sound() from what a text says.
    static std::unique_ptr<const Graph> of_what_is_sound(const Value& root,
                                                         const std::filesystem::path& folder,
                                                         const LoadOptions& options,
                                                         Diagnostics& diagnostics);

    std::span<const GraphNode> nodes() const { return nodes_; }
    int index_of(std::string_view id) const;  // -1 where there is none

    // The nodes to be written, in the file's order.
    const std::vector<int>& sinks() const { return sinks_; }

    // Every node after those it reads.
    const std::vector<int>& order() const { return order_; }
    // The nodes that a node reads.
    const std::vector<int>& links(int node) const { return links_[index(node)]; }

    // The sinks and what they need, directly or not, each after those it reads.
    std::vector<int> nodes_in_use() const;

    const Variables& variables() const { return *scope_->variables; }

    // Groups where they are used: nodes of what they declare, in whose place are those inside.
    std::span<const GraphNode> groups() const { return groups_; }

    // The OpenColorIO config that the graph names; empty where it names none.
    const std::filesystem::path& ocio() const { return ocio_; }

    // The parameters for a frame.  Faults go to the diagnostics and leave a null entry.  Those that depend on
    // the sizes of the leading input have their defaults where these are not known yet.
    FrameNodes at(int frame, Diagnostics& diagnostics) const;
    std::shared_ptr<const Node> at(int node, int frame, Diagnostics& diagnostics,
                                   const InputSizes* sizes = nullptr) const;

    // Whether a parameter depends on the sizes of the leading input.
    bool uses_sizes(int node) const;

    // The input that a node takes its windows from; nothing where none is connected.
    std::optional<Input> leading_input(int node, int frame) const;

    // Whether a node does its work at a frame; else it passes its leading input on, or writes nothing.
    // Nothing where that can't be told, which is a fault.
    std::optional<bool> is_enabled(int node, int frame, Diagnostics& diagnostics) const;

    // Whether a file name of the node holds the frame number.
    bool names_frame(int node) const;

    // Whether the node depends on the frame's number: in a file name, or by ${frame} anywhere else.
    bool uses_frame(int node) const;

    // The first frame that some source finds on disk; nothing where no file name holds the frame.
    std::optional<int> first_frame_on_disk() const;

    // The first that the graph says, else the first on disk.
    std::optional<int> first_frame() const;
    // Every frame that a source in use finds on disk, in increasing order.
    std::vector<int> frames_on_disk() const;

private:
    static std::unique_ptr<const Graph> parse_what_is_sound(std::string_view text, const std::string& name,
                                                            const std::filesystem::path& folder,
                                                            const LoadOptions& options,
                                                            Diagnostics& diagnostics);

    // Those that one node finds, in increasing order.
    std::vector<int> frames_on_disk(const GraphNode& node) const;

    // Tells what is wrong with groups where they are used, and says which nodes are inside of those.
    std::vector<int> check_groups(int frame, Diagnostics& diagnostics) const;
    std::unique_ptr<const Node> make(const GraphNode& node, const Moment& moment,
                                     Diagnostics& diagnostics) const;
    static std::optional<Input> leading_input_of(const GraphNode& node, int frame);
    // With --root all paths begin there, else at the folder of the file that they stand in.
    PathBase path_base(const GraphNode& node) const {
        return {has_root_ ? folder_ : node.scope->folder, has_root_};
    }
    // Whether a node does nothing at any frame.
    bool is_never_enabled(int node) const;

    // Reads, links and chooses, in this order, telling everything that is wrong.
    void build(const Value& root, const LoadOptions& options, Diagnostics& diagnostics);

    std::vector<GraphNode> nodes_, groups_;
    std::vector<int> sinks_, order_;
    std::vector<std::vector<int>> links_;
    std::set<int> misfits_;  // nodes that are linked to another kind of value than they take
    std::shared_ptr<const Scope> scope_;
    std::vector<std::shared_ptr<const Group>> group_files_;
    std::filesystem::path ocio_;
    PathMap path_map_;
    std::filesystem::path folder_;  // what relative paths are relative to
    bool has_root_ = false;         // …those from the command line too
};

}  // namespace keyline
