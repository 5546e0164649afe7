// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/graph/graph.h"
#include "engine/plan/carry.h"
#include "engine/plan/resolve.h"

#include <cstddef>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace keyline {

// The frames of a run that come next, as far as it is worth to look.  They are resolved from their headers,
// and once more when their turn comes: by then a file may be another, or there at last.
class Ahead {
public:
    // `graph` and `frames` must outlive it.  `drop_finished` takes away what a frame need not write.
    Ahead(const Graph& graph, const std::vector<int>& frames, ResolveOptions resolving,
          std::function<void(ResolvedFrame&)> drop_finished = {});

    // Those from position `next` on, after the frame that is about to be planned.  Nothing where frames of
    // this run have nothing in common, which the first of them tell.
    std::span<const ComingFrame> after(const ResolvedFrame& now, std::size_t next);

private:
    void look(std::size_t end);
    std::optional<ComingFrame> resolved(int frame) const;

    const Graph& graph_;
    const std::vector<int>& frames_;
    const ResolveOptions resolving_;
    const std::function<void(ResolvedFrame&)> drop_finished_;
    std::deque<std::pair<std::size_t, ComingFrame>> seen_;  // by position in the run
    std::size_t next_ = 0;                                  // the first position not looked at
    std::optional<bool> have_something_in_common_;
    std::vector<ComingFrame> answer_;
};

}  // namespace keyline
