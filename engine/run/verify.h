// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/run/provenance.h"
#include "engine/run/render.h"

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

// Whether what lies on disk is what a graph makes.

namespace KEYLINE_API keyline {

enum class OutputState {
    kCurrent,  // whole, and made by this graph from these inputs
    kStale,    // whole, and made by another graph or from other inputs
    kForeign,  // whole, and it doesn't tell what made it
    kDamaged,  // not all of it can be decoded
    kMissing,
};
std::string_view output_state_name(OutputState state);

// Of the samples of one channel, in rows from the top; the same whatever the file's format or compression, as
// long as that loses nothing.
struct ChannelHash {
    std::string channel;
    Digest samples;
};

struct Verdict {
    int frame = 0;
    std::string node;  // its id
    std::filesystem::path file;
    OutputState state = OutputState::kCurrent;
    std::vector<std::string> reasons;  // why it is stale, or where it is damaged
    std::vector<ChannelHash> hashes;   // where they were asked for
};

// Looks at every output of the frames, each decoded whole.  A frame that can't be resolved, as an input is
// missing, is an error; the others are looked at.
void verify(const Graph& graph, const RenderOptions& options, bool with_hashes, Diagnostics& diagnostics,
            const std::function<void(const Verdict&)>& hear);

// Whether one output of a frame need not be made again.
bool is_current(const Origins& origins, const ResolvedFrame& frame, const Sink& sink);

}  // namespace keyline
