// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/base/digest.h"
#include "engine/node/node.h"
#include "engine/params/params.h"

#include <memory>
#include <string>
#include <vector>

namespace KEYLINE_API keyline {

enum class NodeKind { kPoint, kStencil, kGather, kDerive, kSource, kSink, kCompound, kGroup };
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
    int version = 1;
    NodeKind kind = NodeKind::kPoint;
    std::vector<FieldInfo> fields;     // inputs and parameters in declared order
    std::vector<std::string> outputs;  // the channels it makes; empty: those of its input.  A group's links
    std::string gives;                 // the kind of data that it makes instead; "": pixels
    const DataParts* parts = nullptr;  // that a link may pick of the data; null: none

    // Makes a node of the members of its object (without `type` and `about`) that have been validated.  Null
    // where the reader was told of an error between them.
    std::unique_ptr<const Node> (*make)(const std::vector<FieldInfo>& fields, const Value& object,
                                        ParamReader& reader) = nullptr;

    // Validates by `fields`, then makes the node.  Null where the reader was told of an error.
    std::unique_ptr<const Node> parse(const Value& object, ParamReader& reader) const;
};

// Of what a node makes by itself: its type, the type's version and its parameters with their defaults.  Names
// of inputs and files are not in it: which pixels they stand for is for those to say who connect and open
// them.
Digest digest_of(const NodeType& type, const Node& node);

}  // namespace keyline
