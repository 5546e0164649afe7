// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/base/digest.h"
#include "engine/base/index.h"
#include "engine/base/print.h"
#include "engine/graph/graph.h"
#include "engine/node/node.h"
#include "engine/plan/session.h"

#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace KEYLINE_API keyline {

// One output of an operation.
//
// Pixels: where they are not 0, and how a file stores them.  A datum: its kind, and the window that it was
// gathered in.
struct ValueInfo {
    Rect window;
    std::optional<SampleType> stored = {};  // the type of the file that samples come from; nothing: computed
    std::string data = {};                  // "": pixels
};

// An operation of one frame: one of the four ways to make a value.
struct Op {
    std::string title;  // "node 'a' (gaussian)"
    Place place;        // of the node
    int node = -1;      // of the graph
    int frame = 0;
    // Of all that its values depend on: the node, its version and its parameters, what it reads, its files as
    // they are.  Equal for the same values of two frames, of two graphs.  Unknown where a source has none.
    Digest digest;
    std::shared_ptr<const ImageSource> source;     // pixels from a file
    std::shared_ptr<const Operation> operation;    // pixels, tile by tile
    std::shared_ptr<const Gather> gather;          // a datum from a sweep over the frame
    std::shared_ptr<const Derivation> derivation;  // a datum between two sweeps
    std::vector<Link> links;
    std::vector<ValueInfo> outputs;
    std::vector<std::size_t> source_group, source_channel;  // of each output of a source

    bool makes_data() const { return gather || derivation; }
};

// "node 'a' (gaussian), frame 7: 1 output of 480 × 270 at (0, 0)"
std::string to_string(const Op& op);

// The stream that leaves a node.
struct NodeStream {
    int node = -1;
    Stream stream;
    Digest digest;
};

struct Sink {
    std::string title;
    Place place;
    SinkRequest request;
    int node = -1;  // of the graph
};

// A node with its parameters at a frame that was looked at: that which is resolved, or another one.
struct NodeAtFrame {
    int node = -1, frame = 0;
    std::shared_ptr<const Node> parsed;
};

// A file that a node looked at, as it was just before.
struct FrameInput {
    int node = -1, frame = 0;
    std::filesystem::path file;
    Digest identity;
};

// What a frame is: its operations in an order in which each comes after what it reads, and what leaves it.
struct ResolvedFrame {
    int frame = 0;
    std::vector<Op> ops;
    std::vector<Sink> sinks;
    std::vector<NodeStream> streams;  // of this frame; where every node was to be resolved

    // What it was made of.
    std::vector<NodeAtFrame> nodes;
    std::vector<FrameInput> inputs;    // in the order of the looks; some may be there twice
    std::set<int> nodes_with_colours;  // those that asked for the colour config

    const ValueInfo& info(ValueRef v) const { return ops[index(v.op)].outputs[index(v.output)]; }
};

// Where a value lies in memory already; null data: nowhere.
inline Plane resident_plane(const ResolvedFrame& frame, ValueRef v) {
    const Op& op = frame.ops[index(v.op)];
    if (!op.source) return {};
    const auto output = static_cast<std::size_t>(v.output);
    return op.source->resident(op.source_group[output], op.source_channel[output]);
}

struct ResolveOptions {
    std::filesystem::path ocio;        // the config; empty: the built-in one
    bool every_node = false;           // resolve those too that nothing written uses
    bool known_sound = false;          // for another frame: a layer that is missing now is its file's fault
    bool leave_out_identities = true;  // nodes that say they change nothing
    bool check_formats = false;        // whether the files written can hold what they are given
    bool inputs_may_come = false;      // what is not there is not finished
    bool faults_told = false;          // those of the graph: only what is sound of it is looked at
    std::shared_ptr<Session> session;  // null: files are read for this frame alone
};

// Forward: display windows, data windows and channels of every stream, from the files' headers alone.  Faults
// of the graph and its files go to the diagnostics; nothing is returned where there was one.
std::optional<ResolvedFrame> resolve(const Graph& graph, int frame, const ResolveOptions& options,
                                     Diagnostics& diagnostics);

}  // namespace keyline
