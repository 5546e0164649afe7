// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/plan/resolve.h"
#include "engine/run/execute.h"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

// Graphs on pictures in memory, through the whole engine: nodes, plan, tiles, threads.  Files have no part.

namespace keyline::bench {

struct Picture {
    int width = 0, height = 0;
    std::vector<std::string> channels;
    std::vector<std::vector<float>> planes;  // one a channel, row by row, and kSlack more

    static constexpr std::size_t kSlack = 16;  // ImageSource::resident

    Picture() = default;
    Picture(int w, int h, std::vector<std::string> names)
        : width(w),
          height(h),
          channels(std::move(names)),
          planes(channels.size(),
                 std::vector<float>(static_cast<std::size_t>(w) * static_cast<std::size_t>(h) + kSlack)) {}
};

class MemoryGraph {
public:
    // `nodes` is the JSON of a graph's nodes without its braces.  In it node "a" is the picture (and node "b"
    // another one of the same), and the node "result" is what is computed.  The picture must outlive the
    // graph.
    MemoryGraph(const std::string& nodes, const Picture& picture, int threads);

    Plan plan() const;

    // Plans and computes the frame.
    void run();

    const Picture& result() const { return *result_; }

private:
    std::unique_ptr<Picture> result_;
    ResolvedFrame frame_;
    int threads_;
    Executor executor_;
};

}  // namespace keyline::bench
