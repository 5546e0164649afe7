// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/run/render.h"

#include <map>
#include <string>
#include <vector>

namespace keyline::cli {

// What the files of one read node are, as far as frames of a shot have it in common.
class FrameChanges {
public:
    explicit FrameChanges(const Graph& graph) : graph_(graph) {}

    // Warns of what differs from the frame that was looked at before: the frame's size, channels that come or
    // go, their types, and the colour space.
    void look(const ResolvedFrame& frame, Diagnostics& diagnostics);

private:
    struct Seen {
        int frame = 0;
        Rect display;
        std::map<std::string, std::string> types;  // of channels
        std::vector<Attribute> colours;            // what the file says of its colour space
    };

    const Graph& graph_;
    std::map<int, Seen> seen_;  // by node
};

// Warns of frames between the first and the last that are not there.
void warn_of_gaps(const std::vector<int>& frames, Diagnostics& diagnostics);

}  // namespace keyline::cli
