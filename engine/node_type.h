// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/node.h"
#include "engine/params.h"

#include <memory>
#include <string>
#include <vector>

namespace keyline {

enum class NodeKind { kPoint, kStencil, kWholeFrame, kSource, kSink, kCompound };
const char* node_kind_name(NodeKind kind);

// One node of a graph with its parameters parsed: knows its inputs and files, and can be resolved for a
// frame.
class Node {
public:
    virtual ~Node() = default;

    // Those that are connected, in declared order; an input's slot is its index here.
    virtual std::vector<Input> inputs() const = 0;
    virtual std::vector<FileName> files() const = 0;

    // Adds what the node computes for the builder's frame.  A sink returns an empty stream.  Throws Failure.
    virtual Stream resolve(Builder& builder) const = 0;

    // Every parameter as JSON, defaults filled in.
    virtual Value to_value() const = 0;
};

// A kind of node that graphs can name.
struct NodeType {
    std::string name, help;
    NodeKind kind = NodeKind::kPoint;
    std::vector<FieldInfo> fields;     // inputs and parameters in declared order
    std::vector<std::string> outputs;  // the channels it makes; empty: those of its input

    // Parses the members of a node's object (without `type` and `about`).  Null where the reader was told of
    // an error.
    std::unique_ptr<const Node> (*parse)(const Value& object, ParamReader& reader) = nullptr;
};

}  // namespace keyline
