// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/graph.h"
#include "engine/node.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace keyline {

// One output of an operation: where it is not 0, and how a file stores it.
struct ValueInfo {
    Rect window;
    std::optional<SampleType> stored;  // the type of the file that the samples come from; nothing: computed
};

// An operation of one frame, or a source (operation null).
struct Op {
    std::string title;  // "node 'a' (gaussian)"
    int frame = 0;
    std::shared_ptr<const Operation> operation;
    std::shared_ptr<const ImageSource> source;
    std::vector<Link> links;
    std::vector<ValueInfo> outputs;
    std::vector<std::size_t> source_group, source_channel;  // of each output of a source
};

struct Sink {
    std::string title;
    Place place;
    SinkRequest request;
};

// What a frame is: its operations in an order in which each comes after what it reads, and what leaves it.
struct ResolvedFrame {
    int frame = 0;
    std::vector<Op> ops;
    std::vector<Sink> sinks;

    const ValueInfo& info(ValueRef v) const {
        return ops[static_cast<std::size_t>(v.op)].outputs[static_cast<std::size_t>(v.output)];
    }
};

// Where a value lies in memory already; null data: nowhere.
inline Plane resident_plane(const ResolvedFrame& frame, ValueRef v) {
    const Op& op = frame.ops[static_cast<std::size_t>(v.op)];
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
    bool faults_told = false;          // those of the graph: only what is sound of it is looked at
};

// Forward: display windows, data windows and channels of every stream, from the files' headers alone.  Faults
// of the graph and its files go to the diagnostics; nothing is returned where there was one.
std::optional<ResolvedFrame> resolve(const Graph& graph, int frame, const ResolveOptions& options,
                                     Diagnostics& diagnostics);

}  // namespace keyline
