// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/plan/output_names.h"
#include "engine/run/render.h"

#include <cstdint>
#include <vector>

namespace keyline {

// Remembers what was written, and looks at the end whether it is still there: somebody may have removed or
// renamed the folder of a run that takes a night, and a run that says it went well is believed.
class LastLook {
public:
    LastLook(const Graph& graph, std::span<const int> frames) : graph_(graph), names_(graph, frames) {}

    // A frame whose outputs stand under their names.
    void remember(int frame, FrameOutcome outcome);

    struct Lost {
        std::vector<std::pair<int, FrameOutcome>> frames;  // each once
        std::vector<Error> errors;                         // one a sink
    };
    // What is not there, or is not what it was.
    Lost lost() const;

private:
    struct Entry {
        int frame;
        FrameOutcome outcome;
    };
    const Graph& graph_;
    OutputNames names_;
    // A few bytes a frame, as there may be many; names are made again.
    std::vector<Entry> entries_;
    std::vector<uint64_t> sizes_;  // of the outputs of all entries
};

}  // namespace keyline
