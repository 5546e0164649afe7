// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/graph/graph.h"
#include "engine/plan/resolve.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

// What an output was made of.  It is written into the output, so that a file tells years later which graph
// made it, and whether the graph would make the same today.

namespace KEYLINE_API keyline {

// The attribute that holds it, as JSON.  Where a format has no place for it, it lies beside the output in a
// file that ends in kBeside, with the digest of the output's bytes.
inline constexpr const char* kProvenance = "keyline/provenance";
inline constexpr const char* kBeside = ".origin.json";

struct Origin {
    // Of all that the pixels depend on: the nodes with their parameters, how they are linked, the bytes of
    // the files.  Names of nodes, folders and the output, times and versions of programs are not in it.
    // Unknown where something has no identity, such as an image in memory.
    Digest digest;
    std::string text;  // the digest and all of it, readable: an object of JSON in one line
};

// Finds the origins of a graph's outputs.
class Origins {
public:
    // `graph` must outlive it.  `ocio` is the colour config, empty for the built-in one.  The session keeps
    // what files hold, as long as they stay the same.
    Origins(const Graph& graph, std::filesystem::path ocio, std::shared_ptr<Session> session)
        : graph_(graph), ocio_(std::move(ocio)), session_(std::move(session)) {}

    // Reads the inputs whole.  Throws Failure (kInput) for one that changes meanwhile.
    Origin of(const ResolvedFrame& frame, const Sink& sink) const;

private:
    const Graph& graph_;
    std::filesystem::path ocio_;
    std::shared_ptr<Session> session_;
};

// Writes it beside an output that is there, where the output can't hold it; `text` is an origin's.  Throws
// Failure (kOutput).
void write_provenance_beside(const std::filesystem::path& output, const std::string& text);

// What a file says of its origin, or what lies beside it; nothing where nobody does.  Throws Failure (kInput)
// as describe_image() does.
std::optional<Value> read_provenance(const std::filesystem::path& file);

// Whether the file has other bytes than what lies beside it tells of; false where nothing does.  Zeros that a
// lost machine left are seen so in formats that have no sum of their own.
bool was_changed_since_made(const std::filesystem::path& file);

// Why the second is not the first, for people: "'smooth.sigma' is 2, and was 1.4", "the input
// 'street.0001.exr' of 'render' is another one".  Empty where no difference is known.
std::vector<std::string> differences(const Value& was, const Value& is);

}  // namespace keyline
