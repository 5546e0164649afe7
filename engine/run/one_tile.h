// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/base/digest.h"
#include "engine/run/render.h"

#include <string>
#include <vector>

namespace KEYLINE_API keyline {

// A region of a node's result, to be computed by itself: what an internal error names to be seen again.
struct OneTile {
    std::string node;  // its id
    int frame = 1;
    Rect region;
};

// "keyline render toon.json --only-tile edges@0,0,64,64 --frames 7", where `command` is the part before.
std::string command_for(const std::string& command, const OneTile& tile);

struct TileChannel {
    std::string name;
    Digest samples;  // of the bits of all, in rows
    float least = 0, most = 0;
    std::size_t not_finite = 0;
};

// Computes it on this thread alone, without a file written.  Nothing where there was an error; what computing
// throws is thrown.
std::vector<TileChannel> render_one_tile(const Graph& graph, const OneTile& tile,
                                         const RenderOptions& options, Diagnostics& diagnostics);

}  // namespace keyline
